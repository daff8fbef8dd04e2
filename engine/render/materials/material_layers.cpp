#include "render/materials/material_layers.h"

#include <cmath>

namespace blush {

namespace {

constexpr float max_film_thickness = 1e6f; // nanometres: beyond this, interference colours average out

} // namespace

LayerRecord layer_factors_of(const Material& m) {
    LayerRecord r;
    if (is_coated(m)) {
        r.clearcoat = unit(m.clearcoat);
        r.clearcoat_roughness = unit(m.clearcoat_roughness);
        if (has_coat_normal_map(m) && std::isfinite(m.clearcoat_normal_scale)) r.clearcoat_normal_scale = m.clearcoat_normal_scale;
    }
    if (has_sheen(m)) {
        r.sheen_color = within(m.sheen_color, 0, 1);
        r.sheen_roughness = unit(m.sheen_roughness);
    }
    if (is_anisotropic(m)) {
        const double angle = std::isfinite(m.anisotropy_rotation_radians) ? double(m.anisotropy_rotation_radians) : 0;
        r.anisotropy = unit(m.anisotropy);
        r.anisotropy_cos = float(std::cos(angle));
        r.anisotropy_sin = float(std::sin(angle));
    }
    if (has_film(m)) {
        r.iridescence = unit(m.iridescence);
        r.film_ior = within(m.iridescence_ior, 1, 1000);
        r.film_thickness_minimum = within(m.iridescence_thickness_minimum, 0, max_film_thickness);
        r.film_thickness_maximum = within(m.iridescence_thickness_maximum, 0, max_film_thickness);
    }
    if (is_translucent(m)) {
        r.diffuse_transmission = unit(m.diffuse_transmission);
        r.diffuse_transmission_color = within(m.diffuse_transmission_color, 0, 1); // more would gain energy
    }
    if (disperses(m)) r.dispersion = within(m.dispersion, 0, 1000);
    return r;
}

Features layer_features_of(const Material& m) {
    Features f = no_features;
    if (is_coated(m)) f = f.with(Feature::clearcoat);
    if (has_coat_normal_map(m)) f = f.with(Feature::normal_maps);
    if (has_sheen(m)) f = f.with(Feature::sheen);
    if (is_anisotropic(m)) f = f.with(Feature::anisotropy);
    if (has_film(m)) f = f.with(Feature::iridescence);
    if (is_translucent(m)) f = f.with(Feature::diffuse_transmission);
    if (disperses(m)) f = f.with(Feature::dispersion);
    return f;
}

bool has_coat_normal_map(const Material& m) { return is_coated(m) && m.clearcoat_normal_texture.texture && m.clearcoat_normal_scale != 0; }

} // namespace blush
