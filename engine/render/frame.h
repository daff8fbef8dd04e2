// A finished image, never modified after publishing; shared by the session and its readers.
#pragma once

#include "core/result.h"
#include "core/vec.h"
#include "render/compile/feature_report.h"
#include "render/diagnostics/health.h"
#include "render/film/path_counts.h"
#include "render/film/stage_times.h"
#include "render/first_hit_planes.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace blush {

struct LightGroups;

struct RayCounts {
    int64_t camera = 0, bounce = 0, shadow = 0;
    int64_t total() const { return camera + bounce + shadow; }
};

// Estimated error of an image against the converged result, from its two half buffers, with 95 % intervals (error_estimate.h).
struct ErrorEstimate {
    bool known = false;                   // relmse; false until both halves hold samples and the interval is meaningful
    double relmse = 0, low = 0, high = 0; // mean of (a - b)^2 / (b^2 + 0.01), b being the true value
    bool rmse_known = false;
    double rmse = 0, rmse_low = 0, rmse_high = 0; // root of the mean of (a - b)^2
    bool misses_highlights = false;               // small highlights widen an interval, or make it unknown (small_highlights.h)
};

// Statistics of a light group before its gain, per channel: the mean of its plane, and the mean square of half the difference of
// its two halves, which is its share of the image's variance (error_estimate.h).
struct GroupShare {
    Vec3d mean{0, 0, 0}, variance{0, 0, 0};
};

// Statistics of clamping.
struct ClampReport {
    int64_t samples = 0;    // clamped samples
    Vec3d removed{0, 0, 0}; // mean over the image, scene-linear RGB
    double share = 0;       // share of the unclamped image's luminance, 0 .. 1
};

struct Frame {
    uint64_t revision = 0;       // of the submission that it belongs to
    uint64_t look = 0;           // Submission::look
    int width = 0, height = 0;   // of the pixels below
    int divider = 1;             // full resolution / this resolution
    int64_t samples = 0;         // per pixel, on average
    double light_path_share = 1; // of the light paths of these samples, so far; below 1 only for a first sample after an edit
    bool complete = false;       // a stop rule is reached
    bool whole = true;           // false: only a region was rendered
    bool transparent = false;    // shadow catcher without a background: alpha is for compositing

    // width * height * 4, scene-linear, top row first; alpha is 1, or coverage
    // if the environment is hidden from the camera; 0 where nothing is rendered
    std::vector<float> rgba;
    std::vector<float> pixel_samples;  // of each pixel; empty if all have the same number
    std::vector<Vec3> albedo, normal;  // empty unless requested; normal in world space
    std::vector<float> depth;          // metres along the ray; 0 on a miss; empty unless requested
    std::vector<uint32_t> object_id;   // Id<Node>.value, 0 on a miss; empty unless requested
    std::vector<uint32_t> material_id; // Id<Material>.value; empty unless requested

    // By which a coarse image is enlarged after denoising (joint_upsampling.h); null: not at all.
    FirstHitPlanesPtr first_hits;
    // With sharp first hits, for the view history of denoised images; else empty.
    std::optional<WorldCamera> camera;

    // Radiance by number of scatterings: 0 directly visible, 1 scattered once, ...; the last holds all further ones. They sum to
    // the beauty. Empty unless requested.
    std::vector<std::vector<Vec3>> bounces;
    // Radiance by the strategy that has found it (FoundBy in film/found_by.h). They sum to the beauty. Empty unless requested.
    std::vector<std::vector<Vec3>> strategies;

    // Radiance by light group (light_groups.h), before gains, and the gains used for rgba and error: rgba is the sum of planes
    // times gains. Empty unless there are groups.
    std::shared_ptr<const LightGroups> light_groups; // null: none
    std::vector<std::string> group_names;
    std::vector<std::vector<Vec3>> groups;
    std::vector<Vec3> gains;
    std::vector<GroupShare> group_shares;

    // Per pixel: mean number of path vertices, and mean survival probability of Russian roulette, 1 if it was never applied.
    // Empty unless requested, like the counts.
    std::vector<float> path_length, survival;
    std::vector<PathCounts> path_counts; // by bounce

    // Standard error of each pixel's mean, RGB, from the two halves. Empty unless requested, and until both hold samples.
    std::vector<Vec3> standard_error;

    // Half of the difference A - B of the two half buffers, times the factor that makes its square an unbiased estimate of the variance of
    // the pixel's mean, RGB, with its sign: means of it over pixels tell the variance of their mean, however their noise is correlated.
    // NaN where a half holds no samples. Empty unless requested, if so everywhere, and for shadow catchers.
    std::vector<Vec3> half_difference;
    std::vector<std::vector<Vec3>> group_half_differences; // of each plane of `groups`

    // The latest error estimate of this image, with the samples per pixel and seconds at which it was made.
    ErrorEstimate error;
    int64_t error_samples = 0;
    double error_at = 0;
    std::string missing_light;                               // user message; empty if all light can be found (missing_light.h)
    std::shared_ptr<const std::vector<Diagnostic>> warnings; // of the compiled scene; null: not rendered from one
    Health health;
    ClampReport clamp;
    RayCounts rays;
    StageSeconds stages;                                 // core seconds of rendering
    double seconds = 0;                                  // of rendering at this revision
    double error_seconds = 0;                            // total time of error estimates in this session
    double first_image_seconds = 0;                      // from submit to the first published frame of this revision
    double samples_per_second = 0;                       // whole-image samples per pixel per second, over the last batch
    std::string kernel;                                  // e.g. "v4/plain"
    std::shared_ptr<const FeatureReport> feature_report; // the features that were compiled for it, and the omitted ones
};

using FramePtr = std::shared_ptr<const Frame>;

} // namespace blush
