// A finished picture, never modified after publishing; shared between the session and whoever looks.
#pragma once

#include "core/vec.h"
#include "render/health.h"
#include "render/ledger.h"
#include "render/path_counts.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace blush {

struct LightGroups;

struct RayCounts {
    int64_t camera = 0, bounce = 0, shadow = 0;
    int64_t total() const { return camera + bounce + shadow; }
};

// The error of a picture against the truth, estimated from its two half buffers, with 95 % intervals (error_estimate.h).
struct ErrorEstimate {
    bool known = false;                   // relmse; false until both halves hold samples and the interval says something
    double relmse = 0, low = 0, high = 0; // mean of (a - b)^2 / (b^2 + 0.01), b being the truth
    bool rmse_known = false;
    double rmse = 0, rmse_low = 0, rmse_high = 0; // root of the mean of (a - b)^2
};

// Of a group of lights, before its gain: the mean of its plane, and of the square of half the difference of its two halves, which is
// its share of the picture's variance (error_estimate.h). Per channel.
struct GroupShare {
    Vec3d mean{0, 0, 0}, variance{0, 0, 0};
};

// What clamping took from the picture.
struct ClampReport {
    int64_t samples = 0;      // that were clamped
    Vec3d removed{0, 0, 0};   // mean over the image, scene-linear RGB
    double share = 0;         // of the luminance that the image would have without clamping, 0 .. 1
};

struct Frame {
    uint64_t revision = 0;     // of the submit that it answers
    int width = 0, height = 0; // of the pixels below
    int divider = 1;           // full resolution / this one
    int64_t samples = 0;       // per pixel, on average
    bool complete = false;     // a stop rule is reached
    bool whole = true;         // false: a region alone was rendered
    bool transparent = false;  // it has a shadow catcher and nothing behind: alpha is for who puts it over something else

    std::vector<float> rgba; // width * height * 4, scene-linear, top row first; alpha is 1, or coverage where an environment is hidden from
                             // the camera; 0 where nothing is rendered
    std::vector<float> pixel_samples; // of each pixel; empty if all have the same number
    std::vector<Vec3> albedo, normal; // empty unless read; normal in world space
    std::vector<float> depth;         // metres along the ray; 0 on a miss; empty unless read
    std::vector<uint32_t> object_id;  // Id<Node>.value, 0 on a miss; empty unless read
    std::vector<uint32_t> material_id; // Id<Material>.value; empty unless read

    // Light by the number of scatterings it took: 0 seen directly, 1 scattered once, ...; the last holds all further ones. They sum to the
    // beauty. Empty unless read.
    std::vector<std::vector<Vec3>> bounces;

    // Light by the group of lights that it came from (light_groups.h), before gains, and the gains that rgba and error have: rgba is the sum
    // of planes times gains. Empty unless there are groups.
    std::shared_ptr<const LightGroups> light_groups; // null: none
    std::vector<std::string> group_names;
    std::vector<std::vector<Vec3>> groups;
    std::vector<Vec3> gains;
    std::vector<GroupShare> group_shares;

    // Of the pixel's paths: mean number of vertices, and the mean probability of going on that roulette gave, 1 where it was never asked.
    // Empty unless read, as are the counts.
    std::vector<float> path_length, survival;
    std::vector<PathCounts> path_counts; // by bounce

    // Standard error of each pixel's mean, RGB, from the two halves. Empty unless read, and before both hold samples.
    std::vector<Vec3> standard_error;

    // The newest estimate of this image's error: of the picture that it was with so many samples per pixel, after so many seconds.
    ErrorEstimate error;
    int64_t error_samples = 0;
    double error_at = 0;
    std::string missing_light; // a sentence; empty where all light can be found (missing_light.h)
    Health health;
    ClampReport clamp;
    RayCounts rays;
    double seconds = 0;        // of rendering at this revision
    double error_seconds = 0;  // that estimating its error took so far, in a session
    double first_image_seconds = 0; // from submit to the first published frame of this revision
    double samples_per_second = 0; // whole-image samples per pixel per second, over the last batch
    std::string kernel;        // e.g. "v4/plain"
    std::shared_ptr<const Ledger> ledger; // what was made for it and what was left out
};

using FramePtr = std::shared_ptr<const Frame>;

} // namespace blush
