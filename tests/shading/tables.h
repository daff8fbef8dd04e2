// Scenes and random numbers for the tests of the material, texture and environment tables.
#pragma once

#include "scene/scene.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <random>

namespace blush {

class Random {
public:
    explicit Random(uint64_t seed) : engine_(seed) {}
    uint32_t bits() { return uint32_t(engine_()); }
    int below(int n) { return int(engine_() % uint64_t(n)); }
    float unit() { return float(bits() >> 8) * 0x1p-24f; }
    float between(float low, float high) { return low + (high - low) * unit(); }
    bool coin() { return below(2) == 1; }
    Vec3 direction() {
        const double y = 1 - 2 * (engine_() * 0x1p-64), phi = 2 * std::numbers::pi * (engine_() * 0x1p-64), r = std::sqrt(1 - y * y);
        return {float(r * std::cos(phi)), float(y), float(r * std::sin(phi))};
    }

private:
    std::mt19937_64 engine_;
};

inline ImagePtr make_float_image(int width, int height, int channels, const std::function<float()>& value) {
    auto image = std::make_shared<Image>();
    image->width = width;
    image->height = height;
    image->channels = channels;
    image->floats.resize(size_t(width) * size_t(height) * size_t(channels));
    for (float& v : image->floats) v = value();
    return image;
}

inline ImagePtr make_byte_image(int width, int height, int channels, const std::function<uint8_t()>& value) {
    auto image = std::make_shared<Image>();
    image->width = width;
    image->height = height;
    image->channels = channels;
    image->bytes.resize(size_t(width) * size_t(height) * size_t(channels));
    for (uint8_t& v : image->bytes) v = value();
    return image;
}

// What KHR_materials_* add, each or not; in two of three materials nothing.
inline void add_layers(Random& random, Material& m) {
    if (random.below(3) != 0) return;
    m.clearcoat = random.coin() ? random.unit() : 0;
    m.clearcoat_roughness = random.unit();
    m.clearcoat_normal_scale = random.between(-2, 2);
    if (random.coin()) m.sheen_color = {random.unit(), random.unit(), random.unit()};
    m.sheen_roughness = random.unit();
    m.anisotropy = random.coin() ? random.unit() : 0;
    m.anisotropy_rotation_radians = random.between(-4, 4);
    m.iridescence = random.coin() ? random.unit() : 0;
    m.iridescence_ior = random.between(1, 2);
    m.iridescence_thickness_maximum = random.between(0, 1000);
    m.diffuse_transmission = random.coin() ? random.unit() : 0;
    m.diffuse_transmission_color = {random.unit(), random.unit(), random.unit()};
    m.dispersion = random.coin() ? random.unit() : 0;
}

// Materials are compiled with textures only if a mesh uses them.
inline Id<Material> add_used_material(Scene& scene, const Material& material) {
    const Id<Material> id = scene.materials.add(material);
    scene.meshes.add({.name = "", .parts = {{nullptr, id}}});
    return id;
}

} // namespace blush
