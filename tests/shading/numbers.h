// All BSDF parameters as numbers, for tests that pack them into lanes and compare bits.
#pragma once

#include "shading/bsdf_types.h"

namespace blush::inline BLUSH_ISA {

template <class P, class Visit> void for_each_value(P& p, const Visit& visit) {
    auto& layers = p.layers;
    for (auto* v : {&p.base_color, &p.specular_color, &layers.clearcoat_normal, &layers.sheen_color, &layers.diffuse_transmission_color})
        for (auto* x : {&v->x, &v->y, &v->z}) visit(*x);
    for (auto* x : {&p.metallic, &p.roughness, &p.ior, &p.specular, &p.transmission, &layers.clearcoat, &layers.clearcoat_roughness,
                    &layers.sheen_roughness, &layers.anisotropy, &layers.iridescence, &layers.film_ior, &layers.film_thickness,
                    &layers.diffuse_transmission})
        visit(*x);
}
constexpr int numbers_of_params = 5 * 3 + 13;

} // namespace blush::inline BLUSH_ISA
