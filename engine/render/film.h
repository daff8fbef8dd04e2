// Sums of samples. Resolving, denoising and looking are readers; only the planes that somebody reads are allocated.
#pragma once

#include "core/parallel.h"
#include "render/bounce_planes.h"
#include "render/error_estimate.h"
#include "render/frame.h"
#include "render/kernels/kernel.h"
#include "render/renderer.h"

#include <cstdint>
#include <mutex>
#include <vector>

namespace blush {

// What a film is made for.
struct FilmSize {
    int width = 1, height = 1;
    PlaneSet planes;
    bool transparent = false; // alpha is coverage
    bool adaptive = false;
};

// Of a film plane: is it there, why, and what a pixel of it takes or would take.
struct PlaneUse {
    const char* name;
    bool used;
    const char* why;
    size_t bytes_per_pixel;
};

class Film {
public:
    static std::vector<PlaneUse> plane_uses(const PlaneSet& planes, bool transparent_background, bool adaptive = false);
    // Throws std::runtime_error, with a sentence for the user, if such a film does not fit into this machine.
    static void require_memory(int width, int height, const PlaneSet& planes, bool adaptive = false);
    // Clears, and allocates what is missing. Throws as above. `adaptive`: how many samples a pixel has in each half depends on the values
    // themselves, so the halves count alike (sample_plan.h).
    void reset(int width, int height, const PlaneSet& planes, bool transparent_background, bool adaptive = false);
    void clear();

    // Of all planes together.
    size_t memory_bytes() const;

    int width() const { return width_; }
    int height() const { return height_; }
    // The kernels must hand over first hits: some plane is made of them.
    bool needs_first_hits() const { return planes_.albedo || planes_.normal || planes_.depth || planes_.ids || transparent_; }
    // How often the kernels must note what a path has gathered: after 0, 1, ... scatterings.
    int needs_bounces() const { return bounces_.columns(); }

    // Adds a tile sample by sample in order, so that sums do not depend on how samples are split into tiles. A sample that is
    // not finite or negative is dropped, counted and remembered. Tiles in flight must not share pixels. Thread-safe.
    void add(const TileJob& job, const TileScratch& tile, uint32_t seed);

    // Sum of the samples of half `half` of a pixel.
    Vec3d sum(size_t pixel, int half) const {
        const Half& h = halves_[2 * pixel + size_t(half)];
        return {h.r, h.g, h.b};
    }
    // Everything the film knows: pixels, planes, health, error. Reuses the frame's memory. Material ids are left as table indices + 1.
    void resolve(Frame& frame, const Workers& workers) const;
    // Standard error of each pixel's mean from the two halves, RGB; empty before both hold samples.
    std::vector<Vec3> standard_error() const;

private:
    struct Half {
        double r = 0, g = 0, b = 0;
        int64_t count = 0;
    };
    struct FeatureSums {
        double albedo[3] = {}, normal[3] = {};
    };

    // What to multiply the sums of the halves of a pixel with so that they add up to its value. All samples count alike, except that
    // adaptive ones count for their half.
    struct Weights {
        double a = 0, b = 0;
    };
    Weights weights(const Half& a, const Half& b) const;
    // Where the other sums of a pixel are that must be right on average: side by side where halves have their own weights.
    size_t place_of(size_t pixel, int64_t sample) const { return adaptive_ ? 2 * pixel + size_t(sample & 1) : pixel; }
    template <class Sum> auto mean_of(size_t pixel, const Weights& w, const Sum& sum) const;

    void add_first_hit(size_t pixel, size_t place, const FirstHitColumns& first, int slot, bool first_of_pixel);
    void resolve_rows(Frame& frame, int first, int last) const;
    ErrorAccumulator error_of_rows(const Frame& frame, int first, int last) const;

    int width_ = 0, height_ = 0;
    PlaneSet planes_;
    bool transparent_ = false, adaptive_ = false;
    std::vector<Half> halves_; // two per pixel: even and odd samples, two randomisations of the sampler
    std::vector<FeatureSums> features_;
    std::vector<int64_t> covered_; // samples that hit something; only for transparent backgrounds
    std::vector<float> depth_;     // of the first sample, as are the ids: means of them mean nothing
    std::vector<uint32_t> object_id_;
    std::vector<int32_t> material_; // index into the material table
    BouncePlanes bounces_;
    std::mutex health_mutex_;
    Health health_;
};

} // namespace blush
