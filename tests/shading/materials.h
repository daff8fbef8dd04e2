// Materials and viewers that the shading tests share.
#pragma once

#include "shading/bsdf.h"

#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace blush {

using Params = BsdfParams<float>;

struct Material {
    std::string name;
    Params params;
};

inline Params lambert(Vec3 color = {1, 1, 1}) { return {color, 0, 1, 1.5f, 0, {1, 1, 1}, 0, true}; }
inline Params plastic(float roughness, Vec3 color = {1, 1, 1}) { return {color, 0, roughness, 1.5f, 1, {1, 1, 1}, 0, true}; }
inline Params metal(float roughness, Vec3 color = {1, 1, 1}) { return {color, 1, roughness, 1.5f, 1, {1, 1, 1}, 0, true}; }
inline Params half_metal(float roughness) { return {{0.9f, 0.6f, 0.2f}, 0.5f, roughness, 1.5f, 0.7f, {1, 0.5f, 0.25f}, 0, true}; }
inline Params thin_glass(float roughness, float transmission = 1) {
    return {{1, 1, 1}, 0, roughness, 1.5f, 1, {1, 1, 1}, transmission, true};
}
inline Params glass(float roughness, float ior, float transmission = 1) {
    return {{1, 1, 1}, 0, roughness, ior, 1, {1, 1, 1}, transmission, false};
}

// The normal of a coat is in the local frame; the default is the base's own.
inline Params coated(Params p, float roughness, float clearcoat = 1, Vec3 normal = {0, 0, 1}) {
    p.layers.clearcoat = clearcoat;
    p.layers.clearcoat_roughness = roughness;
    p.layers.clearcoat_normal = normal;
    return p;
}

inline Params with_sheen(Params p, float roughness, Vec3 color = {1, 1, 1}) {
    p.layers.sheen_color = color;
    p.layers.sheen_roughness = roughness;
    return p;
}
inline Params stretched(Params p, float anisotropy) {
    p.layers.anisotropy = anisotropy;
    return p;
}
inline Params under_film(Params p, float nanometres, float film_ior = 1.33f, float share = 1) {
    p.layers.iridescence = share;
    p.layers.film_ior = film_ior;
    p.layers.film_thickness = nanometres;
    return p;
}
inline Params translucent(Params p, float share, Vec3 color = {1, 1, 1}) {
    p.layers.diffuse_transmission = share;
    p.layers.diffuse_transmission_color = color;
    return p;
}
// Light that is transmitted, diffusely or not, is within a body.
inline Params solid(Params p) {
    p.thin = false;
    return p;
}

// 0.011 is the narrowest lobe that is not a delta.
inline const std::vector<float> roughnesses = {0.011f, 0.05f, 0.2f, 0.5f, 1.f};

inline std::vector<Material> materials() {
    std::vector<Material> all = {{"lambert", lambert({0.8f, 0.5f, 0.1f})}, {"mirror", metal(0)},
                                 {"smooth plastic", plastic(0)},           {"smooth thin glass", thin_glass(0)},
                                 {"smooth glass 1.5", glass(0, 1.5f)},     {"mirror by ior 0", glass(0.3f, 0)}};
    for (const float r : roughnesses) {
        const std::string roughness = " of roughness " + std::to_string(r);
        all.push_back({"metal" + roughness, metal(r, {0.9f, 0.7f, 0.4f})});
        all.push_back({"plastic" + roughness, plastic(r, {0.8f, 0.5f, 0.1f})});
        all.push_back({"half metal" + roughness, half_metal(r)});
        all.push_back({"thin glass" + roughness, thin_glass(r)});
        all.push_back({"thin half-clear plastic" + roughness, thin_glass(r, 0.5f)});
        for (const float ior : {1.f, 1.0001f, 1.5f, 2.5f})
            all.push_back({"glass of ior " + std::to_string(ior) + roughness, glass(r, ior)});
        all.push_back({"half-clear solid" + roughness, glass(r, 1.5f, 0.5f)});
    }
    return all;
}

inline const std::vector<float> layer_roughnesses = {0.05f, 0.3f, 1.f};

// Those with layers and unusual bases. What their parts reflect is narrowest where roughness is `r`.
inline std::vector<Material> layered_materials(float r) {
    const std::string roughness = " of roughness " + std::to_string(r);
    return {{"lacquered lambert" + roughness, coated(lambert({0.8f, 0.5f, 0.1f}), r)},
            {"half-coated metal" + roughness, coated(metal(std::max(r, 0.4f), {0.9f, 0.7f, 0.4f}), r, 0.5f)},
            {"smoothly coated plastic" + roughness, coated(plastic(r, {0.8f, 0.5f, 0.1f}), 0)},
            {"coated glass" + roughness, coated(glass(r, 1.5f), std::max(r, 0.3f))},
            {"velvet" + roughness, with_sheen(lambert({0.3f, 0.1f, 0.2f}), r, {0.9f, 0.5f, 0.7f})},
            {"dusty coated plastic" + roughness, with_sheen(coated(plastic(r), r, 0.8f), std::max(r, 0.3f), {0.3f, 0.3f, 0.2f})},
            {"dusty glass" + roughness, with_sheen(glass(r, 1.5f), 0.5f, {0.4f, 0.4f, 0.4f})},
            {"oily plastic" + roughness, under_film(plastic(r, {0.1f, 0.2f, 0.3f}), 350, 1.4f)},
            {"tempered metal" + roughness, under_film(metal(r, {0.6f, 0.5f, 0.4f}), 250, 1.8f, 0.7f)},
            {"soap bubble" + roughness, under_film(thin_glass(r), 500)},
            {"coloured ball of glass" + roughness, under_film(glass(r, 1.5f), 420, 1.8f)},
            {"leaf" + roughness, translucent(plastic(r, {0.2f, 0.5f, 0.1f}), 0.4f, {0.6f, 0.9f, 0.2f})},
            {"wax" + roughness, solid(translucent(plastic(r, {0.9f, 0.8f, 0.7f}), 0.6f, {0.9f, 0.6f, 0.4f}))},
            {"milky pane" + roughness, translucent(thin_glass(r, 0.5f), 0.5f)}};
}
inline std::vector<Material> layered_materials() {
    std::vector<Material> all = {{"unevenly coated lambert", coated(lambert({0.8f, 0.5f, 0.1f}), 0.5f, 1, {0.28f, 0, 0.96f})},
                                 {"smoothly coated mirror", coated(metal(0), 0, 0.7f)}};
    for (const float r : layer_roughnesses)
        for (const Material& m : layered_materials(r)) all.push_back(m);
    return all;
}

inline std::vector<Material> all_materials() {
    std::vector<Material> all = materials();
    for (const Material& m : layered_materials()) all.push_back(m);
    return all;
}

inline bool is_solid(const Params& p) { return (p.transmission > 0 || p.layers.diffuse_transmission > 0) && !p.thin; }

// Towards a viewer at an angle from the normal; `inside`: below the surface.
struct Viewer {
    float degrees;
    bool inside;
    Vec3 wo() const {
        const double theta = degrees * std::numbers::pi / 180, phi = 0.7;
        const double z = std::cos(theta);
        return {float(std::sin(theta) * std::cos(phi)), float(std::sin(theta) * std::sin(phi)), float(inside ? -z : z)};
    }
};
inline std::vector<Viewer> viewers(const Params& p) {
    std::vector<Viewer> all;
    for (const float degrees : {0.f, 30.f, 60.f, 80.f, 89.f, 89.9f}) {
        all.push_back({degrees, false});
        if (is_solid(p)) all.push_back({degrees, true});
    }
    return all;
}
inline std::string describe(const Material& m, const Viewer& v) {
    return m.name + " at " + std::to_string(v.degrees) + " degrees" + (v.inside ? " from inside" : "");
}

struct Random {
    std::mt19937 bits;
    explicit Random(uint32_t seed) : bits(seed) {}
    float operator()() { return float(bits() >> 8) * 0x1p-24f; }
    Vec3 direction() {
        const float u = (*this)(), v = (*this)();
        return sample_cone(2.f, u, v);
    }
};

template <Features S> BsdfSample<float> sample_next(const Bsdf<float>& b, const Vec3& wo, Random& random) {
    const float u = random(), v = random(), choice = random();
    return sample<S>(b, wo, u, v, choice);
}

} // namespace blush
