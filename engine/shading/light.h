// Light records, one per emitter: an emissive triangle, a point without size, a sphere, a sun, or the environment; and the table
// that selects one with a probability proportional to its power (Shirley, Wang and Zimmerman 1996), or from many by a light tree.
//
// Photometric units as in glTF: candela for points (irradiance I cos / r^2), lux for suns, nits for triangles and spheres. Spots
// and IES lights are points with a profile. Not modelled: KHR_lights_punctual's `range`, which has no physical counterpart.
#pragma once

#include "core/distribution.h"
#include "core/sampling.h"
#include "shading/features.h"
#include "shading/light_profile.h"
#include "shading/light_tree.h"

#include <cstdint>

namespace blush {

enum class LightKind : int32_t { triangle, point, sphere, sun, environment };

struct LightRecord {
    int32_t kind;  // LightKind
    int32_t flags; // LightFlag
    int32_t part;  // triangle: the part whose material and vertices give a varying emission
    int32_t triangle;
    int32_t profile;   // index of the ProfileRecord that scales the emission by direction, -1: none
    int32_t object;    // sphere: Id<Node>.value of its node
    int32_t slot;      // with a tree: its selection slot, which is > 0; in the tree ~ its entry
    Vec3 position;     // triangle: vertex 0; point: itself; sphere: its centre; sun: unit direction towards it
    Vec3 edge1, edge2; // triangle: vertices 1 and 2 minus vertex 0
    // constant triangle, sphere: nits, times the opacity; point: candela; sun: nits of its disk, or lux if parallel
    Vec3 emission;
    float inverse_area; // triangle: 1 / m^2
    float radius;       // sphere: metres
    float cone_height;  // sun: 1 - cos of its angular radius; 0 is a parallel beam
};
enum LightFlag : int32_t {
    light_two_sided = 1,
    light_varying = 2,  // emission or alpha vary over the triangle
    light_mirrored = 4, // edge1 leads to vertex 2 and edge2 to vertex 1, so that their cross product still points outwards
    light_hidden = 8,   // sun: disk invisible to the camera
};

// Lights are selected by power through slots: one per light, or with a tree one for the tree and one for each light outside it.
struct LightTables {
    const LightRecord* lights = nullptr;
    const uint32_t* thresholds = nullptr; // by slot: make_thresholds of the powers
    int32_t count = 0;                    // of slots
    const int32_t* slot_lights = nullptr; // with a tree, by slot: the light; the first slot is the tree
    LightTree tree;
    int32_t environment = -1; // index of the environment, -1: none
    int32_t samples_environment = 0;
    const int32_t* suns = nullptr; // indices of the suns with a disk: escaping rays can hit them
    int32_t sun_count = 0;
    int32_t first_sphere = 0; // index of the first sphere; spheres are consecutive
    ProfileTables profiles;
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

// A light, its selection probability, and the remaining random number: uniform in [0, 1).
template <Features S, class F>
DiscreteSample<F> pick_light(const LightTables& table, const Receiver<F>& to, const Pair<F>& random, const Mask<F>& active) {
    const DiscreteSample<F> slot = sample_discrete<F>(table.thresholds, Int<F>(0), table.count, random.bits_x);
    if constexpr (S.has(Feature::light_tree)) {
        if (table.tree.nodes) {
            const Mask<F> in_tree = as_mask(slot.index == 0);
            const TreeSample<F> leaf = sample_tree<F>(table.tree, to, slot.remainder, random.bits_y, active && in_tree);
            return {select(in_tree, leaf.light, gather(table.slot_lights, slot.index)),
                    select(in_tree, slot.probability * leaf.probability, slot.probability),
                    select(in_tree, leaf.remainder, slot.remainder)};
        }
    }
    return slot;
}

// Probability that pick_light selects `light` for that receiver.
template <Features S, class F>
F light_probability(const LightTables& table, const Receiver<F>& to, const Int<F>& light, const Mask<F>& active) {
    if constexpr (S.has(Feature::light_tree)) {
        if (table.tree.nodes) {
            const Int<F> slot = gather_field(table.lights, &LightRecord::slot, light);
            const F p = discrete_probability<F>(table.thresholds, Int<F>(0), Int<F>(table.count), max(slot, Int<F>(0)));
            const Mask<F> in_tree = active && as_mask(slot < 0);
            return any(in_tree) ? select(in_tree, p * tree_probability<F>(table.tree, to, Int<F>(~slot), light, in_tree), p) : p;
        }
    }
    return discrete_probability<F>(table.thresholds, Int<F>(0), Int<F>(table.count), light);
}

// Converts a density per area on a surface tilted by cos_light, at distance^2, to solid angle.
template <class F> F area_to_solid_angle(const F& area_pdf, const F& distance_squared, const F& cos_light) {
    return area_pdf * distance_squared / cos_light;
}

// Uniform pdf over directions in a cone of the given height.
template <class F> F cone_pdf(const F& height) { return F(0.5f * inv_pi) / height; }

// True if the direction is within the sun's disk. Compares chords, |a - b|^2 = 2 (1 - cos), because 1 - dot loses all digits.
template <class F> Mask<F> in_sun_disk(const Vec<F>& direction, const Vec<F>& towards_sun, const F& cone_height) {
    const Vec<F> chord = direction - towards_sun;
    return dot(chord, chord) <= 2.f * cone_height;
}

} // namespace blush::inline BLUSH_ISA
