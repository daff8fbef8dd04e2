// Light records, one per emitter: an emissive triangle, a point without size, a sphere, a sun, or the environment; and the table
// that selects one: by a light tree in proportion to its estimated irradiance at the receiver, or by power if there is only one.
//
// Photometric units as in glTF: candela for points (irradiance I cos / r^2), lux for suns, nits for triangles and spheres. Spots
// and IES lights are points with a profile. Not modelled: KHR_lights_punctual's `range`, which has no physical counterpart.
#pragma once

#include "core/distribution.h"
#include "core/sampling.h"
#include "shading/features.h"
#include "shading/light_profile.h"
#include "shading/light_selection.h"
#include "shading/portals.h"

#include <cstddef>
#include <cstdint>

namespace blush {

enum class LightKind : int32_t { triangle, point, sphere, sun, environment };

struct alignas(128) LightRecord {
    // Light sampling reads these 64 bytes, one cache line.
    int32_t kind;           // LightKind
    int32_t flags;          // LightFlag
    int32_t clearance = -1; // triangle on the convex hull of its mesh: the box of the mesh in LightTables::clearances; -1: none
    Vec3 position;          // triangle: vertex 0; point: itself; sphere: its centre; sun: unit direction towards it
    Vec3 edge1, edge2;      // triangle: vertices 1 and 2 minus vertex 0
    // constant triangle, sphere: nits, times the opacity; point: candela; sun: nits of its disk, or lux if parallel
    Vec3 emission;
    float inverse_area; // triangle: 1 / m^2

    int32_t part; // triangle: the part whose material and vertices give a varying emission
    int32_t triangle;
    int32_t profile;   // index of the ProfileRecord that scales the emission by direction, -1: none
    int32_t object;    // sphere: Id<Node>.value of its node
    int32_t slot;      // in the tree: ~ its entry; distant: its index among the distant lights, or in slot_lights if they are one
    float radius;      // sphere: metres
    float cone_height; // sun: 1 - cos of its angular radius; 0 is a parallel beam
};
static_assert(offsetof(LightRecord, part) == 64);
// True for lights that no ray can hit.
inline bool has_zero_size(const LightRecord& light) {
    return LightKind(light.kind) == LightKind::point || (LightKind(light.kind) == LightKind::sun && !(light.cone_height > 0));
}
enum LightFlag : int32_t {
    light_two_sided = 1,
    light_varying = 2,  // emission or alpha vary over the triangle
    light_mirrored = 4, // edge1 leads to vertex 2 and edge2 to vertex 1, so that their cross product still points outwards
    light_hidden = 8,   // sun: disk invisible to the camera
};

// Contains an emissive mesh and no other geometry (lamp_clearance.h). Infinite: other geometry is near the mesh.
struct ClearanceBox {
    Vec3 low, high;
};

struct LightTables {
    const LightRecord* lights = nullptr;
    int32_t count = 0; // the first lights, which light sampling can select
    LightTree tree;    // empty: they are selected by power
    // make_thresholds of the powers of the first lights; or, with a tree, of the distant lights if they are one to the tree.
    const uint32_t* thresholds = nullptr;
    const int32_t* slot_lights = nullptr; // these distant lights
    int32_t slot_count = 0;               // 0: they are selected one by one
    int32_t environment = -1;             // index of the environment, -1: none
    int32_t samples_environment = 0;
    const int32_t* suns = nullptr; // indices of the suns with a disk: escaping rays can hit them
    int32_t sun_count = 0;
    int32_t first_sphere = 0;                 // index of the first sphere; spheres are consecutive
    const ClearanceBox* clearances = nullptr; // null: all boxes are infinite
    ProfileTables profiles;
    PortalTables portals; // of the environment
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

// A light, its selection probability, and the remaining random number: uniform in [0, 1).
template <Features S, class F>
DiscreteSample<F> pick_light(const LightTables& table, const Receiver<F>& to, const Pair<F>& random, const Mask<F>& active) {
    if constexpr (S.has(Feature::light_tree)) {
        if (!table.tree.empty()) {
            const auto fetch = [&](int32_t light) { __builtin_prefetch(table.lights + light); };
            const TreeSample<F> s = sample_tree<F>(table.tree, to, unit_float<F>(random.bits_x), random.bits_y, active, fetch);
            const Mask<F> among_distant = active && as_mask(s.light < 0);
            if (!any(among_distant)) return {s.light, s.probability, s.remainder};
            const UInt<F> slot_bits = (to_unsigned(to_int(F(s.remainder * 0x1p24f))) << 8) | (pcg_hash(random.bits_x) >> 24);
            const DiscreteSample<F> slot = sample_discrete<F>(table.thresholds, Int<F>(0), table.slot_count, slot_bits);
            return {select(among_distant, gather(table.slot_lights, slot.index), s.light),
                    select(among_distant, s.probability * slot.probability, s.probability),
                    select(among_distant, slot.remainder, s.remainder)};
        }
    }
    return sample_discrete<F>(table.thresholds, Int<F>(0), table.count, random.bits_x);
}

// Probability that pick_light selects `light` for that receiver.
template <Features S, class F>
F light_probability(const LightTables& table, const Receiver<F>& to, const Int<F>& light, const Mask<F>& active) {
    if constexpr (S.has(Feature::light_tree)) {
        if (!table.tree.empty()) {
            const Int<F> slot = gather_field(table.lights, &LightRecord::slot, light);
            const Mask<F> among_distant = active && as_mask(slot >= 0) && Mask<F>(table.slot_count > 0);
            const F p = tree_probability<F>(table.tree, to, select(among_distant, Int<F>(0), slot), light, active);
            if (!any(among_distant)) return p;
            const Int<F> own = select(among_distant, slot, Int<F>(0));
            return select(among_distant, p * discrete_probability<F>(table.thresholds, Int<F>(0), Int<F>(table.slot_count), own), p);
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
