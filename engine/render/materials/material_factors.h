// Internal to material_*.cpp: clamps the factors of a material and tells which lobes it has.
#pragma once

#include "scene/scene.h"
#include "shading/microfacet.h"

#include <algorithm>

namespace blush {

// NaN becomes `low`.
inline float within(float x, float low, float high) { return x >= low ? std::min(x, high) : low; }
inline float unit(float x) { return within(x, 0, 1); }
inline Vec3 within(const Vec3& v, float low, float high) {
    return {within(v.x, low, high), within(v.y, low, high), within(v.z, low, high)};
}

// Lobes of a material, following the precedence of glTF's parameters.
inline bool reflects(const Material& m) { return !m.unlit && (m.specular > 0 || m.metallic > 0 || m.transmission > 0); }
inline bool transmits(const Material& m) { return !m.unlit && m.transmission > 0; }
inline bool is_translucent(const Material& m) { return !m.unlit && m.diffuse_transmission > 0; }
inline bool is_thin(const Material& m) { return !(m.thickness > 0); }

inline bool is_smooth(const Material& m) { return reflects(m) && unit(m.roughness) < smooth_roughness; }

// True if the material may be Lambertian, and not black, somewhere: no factor that a texture cannot set to zero gives it another
// lobe.
inline bool may_be_lambertian(const Material& m) {
    const auto vanishes = [](float factor, const TextureRef& texture) { return !(factor > 0) || texture.texture; };
    return !m.unlit && max_component(m.base_color) > 0 && vanishes(m.specular, m.specular_texture) &&
           vanishes(m.metallic, m.metallic_roughness_texture) && vanishes(m.transmission, m.transmission_texture);
}

// Light travels inside it.
inline bool is_solid(const Material& m) { return (transmits(m) || is_translucent(m)) && !is_thin(m); }
// A thin wall that is smooth, or may be in places where a texture makes it so: light may pass it straight through.
inline bool may_pass_straight(const Material& m) {
    return transmits(m) && is_thin(m) && (is_smooth(m) || m.metallic_roughness_texture.texture);
}

// A texture slot of Material and the corresponding field of a compiled record.
template <class Record> struct CompiledSlot {
    TextureRef Material::*ref;
    int32_t Record::*index;
    bool is_color;
    bool (*matters)(const Material&);

    bool is_read(const Material& m) const { return (m.*ref).texture && matters(m); }
};

} // namespace blush
