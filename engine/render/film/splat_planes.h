// Light paths connected to the camera: what they add to the pixels of a film.
#pragma once

#include "core/parallel.h"
#include "core/vec.h"
#include "render/diagnostics/health.h"
#include "render/film/splat.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// Sums in double precision for each half of the film. Any light path may reach any pixel, so their number is that of whole passes
// over the image: half h of a pixel has the value (sum of its samples) / (its samples) + (sum of its splats) / (passes of h).
class SplatPlanes {
public:
    static constexpr size_t bytes_per_pixel = 2 * sizeof(Vec3d);

    size_t memory_bytes() const { return sums_.capacity() * sizeof(Vec3d); }
    // Clears the planes; 0 pixels: none.
    void reset(size_t pixels);
    bool on() const { return !sums_.empty(); }

    // Adds the splats of pass `pass`, each pixel's in the order of the lists, and counts it. Not thread-safe. Returns the splats
    // that are not finite or negative, which are not added, in an order that depends on `workers`.
    std::vector<BadSample> add_pass(int64_t pass, std::span<const std::span<const Splat>> tiles, int width, uint32_t seed,
                                    const Workers& workers);

    // The splats of a half of a pixel, scaled as if its `count` samples were as many as the passes.
    Vec3d sum_for(size_t pixel, int half, int64_t count) const {
        const int64_t passes = passes_[size_t(half)];
        if (passes == 0) return {0, 0, 0};
        const Vec3d& s = sum(pixel, half);
        const double scale = double(count) / double(passes); // 1 in most pixels: exactly the sum
        return {s.x * scale, s.y * scale, s.z * scale};
    }
    Vec3d& sum(size_t pixel, int half) { return sums_[2 * pixel + size_t(half)]; }
    const Vec3d& sum(size_t pixel, int half) const { return sums_[2 * pixel + size_t(half)]; }
    // Of both halves.
    const std::array<int64_t, 2>& passes() const { return passes_; }
    void set_passes(const std::array<int64_t, 2>& passes) { passes_ = passes; }

private:
    std::vector<Vec3d> sums_; // the halves of one pixel are adjacent
    std::array<int64_t, 2> passes_{};
};

} // namespace blush
