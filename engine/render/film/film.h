// Sums of samples. Frames, denoiser and views only read it; planes that are not used are not allocated. The sums are exact
// (exact_sum.h): they depend neither on the order of the samples nor on how these are split into films that are added later. Depth
// and ids are those of the first sample.
#pragma once

#include "core/exact_sum.h"
#include "core/math.h"
#include "core/parallel.h"
#include "render/diagnostics/health_recorder.h"
#include "render/error/error_estimate.h"
#include "render/film/bounce_planes.h"
#include "render/film/clamp_stats.h"
#include "render/film/edges/edge_pixels.h"
#include "render/film/film_size.h"
#include "render/film/found_by.h"
#include "render/film/group_planes.h"
#include "render/film/shadow_catcher.h"
#include "render/film/splat_planes.h"
#include "render/frame.h"
#include "render/kernels/kernel.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace blush {

// A pixel as the means of its two half buffers. Unknown until both have samples.
struct PixelHalfBuffers {
    bool known = false;
    Vec3d a{0, 0, 0}, b{0, 0, 0}; // means
    double weight_a = 0.5;        // weight of a in the image: n_a / (n_a + n_b), or 1/2
};

// Feature report of a film plane: allocated or not, the reason, and its (potential) bytes per pixel.
struct PlaneUse {
    const char* name;
    bool used;
    const char* why;
    size_t bytes_per_pixel;
};

class Film {
public:
    static std::vector<PlaneUse> plane_uses(const FilmSize& size);
    // Throws std::runtime_error with a user message if such a film does not fit into memory.
    static void require_memory(const FilmSize& size);
    // Clears, and allocates missing planes. Throws as above. Adaptive: each half's sample count depends on sample values, so both
    // halves get equal weight (sample_allocation.h).
    void reset(const FilmSize& size, const Clamp& clamp = {});
    void clear();
    // Frees all planes not listed; the listed ones must exist.
    void keep_only(const PlaneSet& planes);
    // Gains for the groups' planes, applied to all later reads; one gain for each.
    void set_gains(std::span<const Vec3> gains);

    // Of all planes.
    size_t memory_bytes() const;

    int width() const { return width_; }
    int height() const { return height_; }
    // True if the kernels must record first hits.
    bool needs_first_hits() const { return planes_.albedo || planes_.normal || planes_.depth || planes_.ids || transparent_; }
    // Number of columns in which the kernels must record a path's radiance after 0, 1, ... scatterings.
    int needs_bounces() const { return std::max(bounces_.columns(), clamp_.columns()); }
    int needs_groups() const { return groups_.groups(); }
    // The kernels must also record direct light (at most one scattering) per group.
    bool needs_direct_groups() const { return needs_groups() > 0 && clamp_.columns() > 0; }
    bool needs_roulette() const { return planes_.roulette; }
    // The kernels must record radiance by strategy, and direct light apart if clamping excludes it.
    bool needs_strategies() const { return planes_.strategies; }
    bool needs_direct_strategies() const { return needs_strategies() && clamp_.columns() > 0; }

    // Finds the cause of an invalid sample of pixel (x, y).
    using Diagnose = std::function<Fault(int x, int y, int64_t sample)>;
    // Adds the samples of a tile. Samples that are not
    // finite or negative are dropped, counted and recorded with their diagnosis. Concurrent tiles must not share pixels.
    // Thread-safe. `caught`: for a film with a shadow catcher.
    void add(const TileJob& job, const TileScratch& tile, uint32_t seed, const Diagnose& diagnose = {},
             const CatcherColumns* caught = nullptr);

    // Adds `sign` times the tile's radiance, emission at first hits, to the first sample of these pixels, which the film must hold;
    // where it was dropped, nothing.
    void add_to_first_sample(const TileJob& job, const TileScratch& tile, const EdgePixels& pixels, double sign);

    // Adds what the light paths of pass `pass` of the image bring to any pixel to a film with light paths. Splats that are not finite or
    // negative are dropped, counted and recorded with the pass as their sample. Pass i belongs to the half of sample i. Not
    // thread-safe: neither during another pass nor while tiles are added. `traced`: the share of its light paths so far; below 1 the others
    // must follow before another pass. Until then these stand for all.
    void add_pass(int64_t pass, std::span<const std::span<const Splat>> tiles, const Workers& workers, uint32_t seed = 0,
                  double traced = 1);
    // Adds planes for light paths to a film that has none. `size`: its own, with light paths. Throws as reset().
    void begin_light_paths(const FilmSize& size);
    bool has_light_paths() const { return splats_.on(); }
    // Passes of light paths in both halves.
    const std::array<int64_t, 2>& passes() const { return splats_.passes(); }
    void set_passes(const std::array<int64_t, 2>& passes) { splats_.set_passes(passes); }

    // Sum of the samples of half `half` of a pixel, with the groups' gains applied, and of its splats, scaled such that the sum
    // divided by the number of samples is the mean of the half.
    Vec3d sum(size_t pixel, int half) const {
        if (mixed_) return mixed_sum(pixel, half);
        return unmixed_sum(pixel, half);
    }
    // Calls change(index) for the material of each pixel's first hit.
    template <class Change> void each_material(const Change& change) {
        for (int32_t& index : material_) change(index);
    }
    bool has_samples(size_t pixel) const { return half_buffers_[0][pixel].count + half_buffers_[1][pixel].count > 0; }
    const Health& health() const { return health_.health(); }
    // Continues from the health record of another film (film_state.h).
    void restore_health(const Health& health) { health_.restore(health); }
    PixelHalfBuffers half_buffers(size_t pixel) const;
    // Adaptive films: variance of a caught shadow's opacity in one half of the pixel's samples, from the difference of the
    // halves; 0 without a shadow catcher or if a half is empty.
    double shadow_variance(size_t pixel) const;
    // Writes everything except the error: pixels, planes, health.
    // Reuses the frame's memory. Material ids remain table indices + 1.
    void resolve(Frame& frame, const Workers& workers) const;
    // `sharing`: see reuse_covariance.h. `edges`: the pixels with more samples of the emission; null: none, or not known.
    ErrorEstimate estimate_error(const Workers& workers, double sharing = 1, const EdgePixels* edges = nullptr) const;
    // Standard error of each pixel's mean from the two halves, RGB; empty before both hold samples.
    std::vector<Vec3> standard_error() const;

private:
    friend struct FilmPlanes;

    struct HalfBuffer {
        ExactSum3 sum;
        int64_t count = 0;
        void add(const Vec3d& c) {
            sum.add(c);
            ++count;
        }
    };
    // Of numbers that rounded_for_sums() has rounded: exact.
    struct FeatureSums {
        double albedo[3] = {}, normal[3] = {};
    };

    // Factors for the sums of a pixel's halves such that they add up to its value. All samples have equal weight; adaptive films
    // weight the halves equally.
    struct Weights {
        double a = 0, b = 0;
    };
    Weights weights(const HalfBuffer& a, const HalfBuffer& b) const;
    // Index of a pixel's sums in planes that must be unbiased: with separate half weights there are two places, side by side.
    size_t place_of(size_t pixel, int64_t sample) const { return adaptive_ ? 2 * pixel + size_t(sample & 1) : pixel; }
    template <class Sum> auto mean_of(size_t pixel, const Weights& w, const Sum& sum) const;

    // Reports of one tile.
    struct Findings {
        std::vector<BadSample> dropped;
        std::vector<Firefly> fireflies;
    };
    struct SampleName {
        int x, y;
        int64_t sample;
        uint32_t seed;
    };

    // As sum(), without the groups' gains.
    Vec3d unmixed_sum(size_t pixel, int half) const {
        const HalfBuffer& h = half_buffers_[size_t(half)][pixel];
        if (!splats_.on()) return h.sum.value();
        return h.sum.value() + splats_.sum_for(pixel, half, h.count);
    }
    // Sum over the groups, each times its gain.
    Vec3d mixed_sum(size_t pixel, int half) const;
    // Of one group, or of one strategy, with the splats as for sum().
    Vec3d group_sum(size_t pixel, int half, size_t group) const;
    Vec3d strategy_sum(size_t pixel, int half, FoundBy by) const;
    Vec3d sum_of(size_t pixel) const;
    // False if the pixel's next samples are neither clamped nor among the worst fireflies, since their components sum to at most `sum`.
    bool is_notable(size_t pixel, int samples, double sum) const;
    // The same for samples of any pixel: none up to this sum is notable.
    float least_notable_sum() const;
    bool has_planes() const {
        return needs_first_hits() || planes_.bounces > 0 || planes_.roulette || planes_.strategies || needs_groups() > 0;
    }
    // Adds a sample to all planes except the beauty; call it before adding to the beauty.
    void add_planes(size_t pixel, int half, const TileScratch& tile, int slot, const ClampStats::ClampResult& left);
    void add_notable(size_t pixel, const SampleName& at, const TileScratch& tile, int slot, const Diagnose& diagnose, Findings& findings,
                     const CatcherColumns* caught);
    void add_caught(size_t place, const TileScratch& tile, const CatcherColumns& caught, int slot, const Vec3d& radiance);
    void resolve_caught(float* rgba, size_t pixel, const Weights& w) const;
    void add_first_hit(size_t pixel, size_t place, const FirstHitColumns& first, int slot, bool first_of_pixel);
    // Sums over bands of rows.
    struct Totals {
        Vec3d kept{0, 0, 0}, removed{0, 0, 0};
        int64_t clamped = 0;
        bool has_both_halves = false; // any pixel
        std::vector<GroupShare> groups;
        void merge(const Totals& other);
    };
    bool wants_half_difference() const { return planes_.half_difference && !catches_; }
    Vec3 half_difference(size_t pixel) const; // Frame::half_difference
    void resolve_groups(Frame& frame, size_t pixel, const Weights& w, std::vector<GroupShare>& shares) const;
    void resolve_rows(Frame& frame, int first, int last, Totals& totals) const;
    // Bands have a fixed number of rows and are summed in order, so totals do not depend on threads.
    static constexpr int band_rows = 32;
    size_t count_bands() const;
    void for_each_band(const Workers& workers, const std::function<void(size_t band, int first, int last)>& task) const;
    void load_half_buffers(int y, float scale, const EdgePixels* edges, HalfBufferRow& row) const;

    int width_ = 0, height_ = 0;
    PlaneSet planes_;
    bool transparent_ = false, adaptive_ = false, catches_ = false, light_paths_ = false;
    Clamp clamping_;
    int group_count_ = 0;
    // Even and odd samples: two randomisations of the sampler. Apart, because a pass over the image adds to one of them.
    std::array<std::vector<HalfBuffer>, 2> half_buffers_;
    std::vector<FeatureSums> features_;
    std::vector<int64_t> covered_; // samples that hit something; only for transparent backgrounds
    std::vector<float> depth_;     // of the first sample, like the ids: their means are meaningless
    std::vector<uint32_t> object_id_;
    std::vector<int32_t> material_; // index into the material table
    std::vector<Vec3d> paths_;      // per pixel: path length, number of roulette decisions, sum of rounded survival probabilities
    BouncePlanes bounces_;
    GroupPlanes groups_;
    GroupPlanes strategies_;         // by FoundBy, without light paths
    std::vector<Vec3> gains_;        // of the light groups
    bool mixed_ = false;             // some gain is not 1
    std::vector<CaughtSums> caught_; // only with a shadow catcher
    SplatPlanes splats_;
    ClampStats clamp_;
    HealthRecorder health_;
};

} // namespace blush
