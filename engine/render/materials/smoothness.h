// How smooth surfaces are: whether they cast caustics, reflect small lights weakly, or have delta lobes. Where textures decide, points of
// the surface are looked up.
#pragma once

#include "render/materials/material_table.h"
#include "scene/scene.h"

namespace blush {

// Shares of a surface's area in [0, 1] that are:
struct Smoothness {
    // Smooth or nearly smooth mirrors and glass, whose caustics NEE rarely or never finds.
    float casts_caustics = 0;
    // Other smooth or nearly smooth surfaces that reflect some light: window glass, plastic, varnish. The few rays that they reflect
    // rarely find a small light, and light paths alone find lights without size there.
    float reflects_weakly = 0;
    // Surfaces that reflect by a delta lobe, of the base or of the clear coat.
    float is_mirror = 0;
    // Surfaces that refract by a delta lobe; not panes, which pass light straight through (thin_transmission.h).
    float is_glass = 0;
    bool operator==(const Smoothness&) const = default;
};

// By the factors alone: each share is 0 or 1.
Smoothness smoothness_of(const Material& material);
// The larger of each share.
Smoothness largest_of(const Smoothness& a, const Smoothness& b);
// True if textures decide where the material is smooth, and the factors allow it.
bool is_smooth_by_texture(const Material& material);
// True if the material casts caustics, or textures may make it do so.
bool may_cast_caustics(const Material& material);

// Of the material `id` on this geometry: the mean over 256 points, evenly spread over its area in object space, with textures that are
// not filtered. `table` holds the material. 0 for geometry without area.
Smoothness smoothness_of(const Geometry& geometry, const Material& material, Id<Material> id, const MaterialTable& table);

} // namespace blush
