// Light paths connected to the camera: what they add to the pixels of a film.
#pragma once

#include "core/exact_sum.h"
#include "core/parallel.h"
#include "render/diagnostics/health.h"
#include "render/film/splat.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// Exact sums for each half of the film. Any light path may reach any pixel, so their number is that of whole passes
// over the image: half h of a pixel has the value (sum of its samples) / (its samples) + (sum of its splats) / (passes of h).
class SplatPlanes {
public:
    // `bounces`, `groups`: as of reset().
    static size_t bytes_per_pixel(int bounces, int groups) { return 2 * size_t(1 + bounces + groups) * sizeof(ExactSum3); }

    size_t memory_bytes() const { return (sums_.capacity() + by_bounce_.memory() + by_group_.memory()) * sizeof(ExactSum3); }
    // Clears the planes; 0 pixels: none. `bounces`: planes by the number of scatterings, the last one of all further ones;
    // `groups`: planes by light group.
    void reset(size_t pixels, int bounces = 0, int groups = 0);
    // Frees the planes by the number of scatterings.
    void drop_bounces() { by_bounce_ = {}; }
    bool on() const { return !sums_.empty(); }

    // Adds the splats of pass `pass` and counts it. Not thread-safe. Returns the splats
    // that are not finite or negative, which are not added, in an order that depends on `workers`. `traced`: the share of its light paths
    // that these are, together with those of an earlier call; below 1 the others must follow before another pass.
    std::vector<BadSample> add_pass(int64_t pass, std::span<const std::span<const Splat>> tiles, int width, uint32_t seed,
                                    const Workers& workers, double traced = 1);

    // The splats of a half of a pixel, scaled as if its `count` samples were as many as the passes.
    Vec3d sum_for(size_t pixel, int half, int64_t count) const { return scaled(sum(pixel, half), half, count); }
    // The same of one plane.
    Vec3d bounce_for(size_t pixel, int half, size_t bounce, int64_t count) const {
        return scaled(bounce_sum(pixel, half, bounce), half, count);
    }
    Vec3d group_for(size_t pixel, int half, size_t group, int64_t count) const {
        return scaled(group_sum(pixel, half, group), half, count);
    }
    int bounces() const { return by_bounce_.count; }
    int groups() const { return by_group_.count; }
    ExactSum3& bounce_sum(size_t pixel, int half, size_t bounce) { return by_bounce_.sums[by_bounce_.place(pixel, half) + bounce]; }
    const ExactSum3& bounce_sum(size_t pixel, int half, size_t bounce) const {
        return by_bounce_.sums[by_bounce_.place(pixel, half) + bounce];
    }
    ExactSum3& group_sum(size_t pixel, int half, size_t group) { return by_group_.sums[by_group_.place(pixel, half) + group]; }
    const ExactSum3& group_sum(size_t pixel, int half, size_t group) const { return by_group_.sums[by_group_.place(pixel, half) + group]; }
    ExactSum3& sum(size_t pixel, int half) { return sums_[2 * pixel + size_t(half)]; }
    const ExactSum3& sum(size_t pixel, int half) const { return sums_[2 * pixel + size_t(half)]; }
    // Of both halves.
    const std::array<int64_t, 2>& passes() const { return passes_; }
    void set_passes(const std::array<int64_t, 2>& passes) { passes_ = passes; }

private:
    // The splats again, in `count` planes: those of one half of a pixel are adjacent.
    struct Split {
        int count = 0;
        std::vector<ExactSum3> sums;
        size_t place(size_t pixel, int half) const { return (2 * pixel + size_t(half)) * size_t(count); }
        size_t memory() const { return sums.capacity(); }
        void reset(size_t pixels, int planes);
        void add(size_t pixel, int half, size_t plane, const Vec3d& radiance);
    };
    Vec3d scaled(const ExactSum3& exact, int half, int64_t count) const {
        const double passes = double(passes_[size_t(half)]) - missing_[size_t(half)];
        if (passes == 0) return {0, 0, 0};
        const double scale = double(count) / passes; // 1 in most pixels: exactly the sum
        const Vec3d sum = exact.value();
        return {sum.x * scale, sum.y * scale, sum.z * scale};
    }

    std::vector<ExactSum3> sums_; // the halves of one pixel are adjacent
    Split by_bounce_, by_group_;
    std::array<int64_t, 2> passes_{};
    std::array<double, 2> missing_{}; // shares of the last passes that are still to be traced
};

} // namespace blush
