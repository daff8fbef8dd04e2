// The planes and the size of a film, for sessions and views that do not need the film itself.
#pragma once

namespace blush {

// Bounce planes: 24 bytes per pixel each.
constexpr int max_bounce_planes = 32, default_bounce_planes = 8;

// Film planes in addition to the beauty. Planes that are not used are not allocated.
struct PlaneSet {
    bool albedo = false, normal = false, depth = false, ids = false;
    // Radiance by the number of scatterings: 0, 1, ..., bounces - 1 and all further ones; 0: none, else 2 .. max_bounce_planes.
    int bounces = 0;
    bool roulette = false;        // path length and survival probability of each pixel, paths by bounce
    bool error = false;           // standard error of each pixel's mean: computed from the two halves, needs no plane of its own
    bool strategies = false;      // radiance by the strategy that has found it (found_by.h)
    bool half_difference = false; // Frame::half_difference, also of light groups: like the error
    bool operator==(const PlaneSet&) const = default;
    // True if it includes all planes of `other`.
    bool covers(const PlaneSet& other) const {
        return albedo >= other.albedo && normal >= other.normal && depth >= other.depth && ids >= other.ids && roulette >= other.roulette &&
               strategies >= other.strategies && (bounces == other.bounces || other.bounces == 0);
    }
};

// Configuration of a film.
struct FilmSize {
    int width = 1, height = 1;
    PlaneSet planes = {};
    bool transparent = false; // alpha is coverage
    bool adaptive = false;
    int groups = 0;       // light groups, one plane each
    bool catches = false; // records shadows (shadow_catcher.h)
    // Light paths add to it (splat_planes.h).
    bool light_paths = false;
};

} // namespace blush
