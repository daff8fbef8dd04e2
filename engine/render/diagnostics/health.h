// Invalid samples, their causes, and fireflies. Samples are identified by (pixel, sample, seed), so that each can be traced
// again.
#pragma once

#include "core/vec.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// The first invalid value of a sample: where in the estimator it arose, and at which vertex of the path.
struct Fault {
    enum class Kind : uint8_t { nan, infinite, negative, zero_pdf, overflowing_pdf };
    enum class Place : uint8_t {
        camera,       // the camera ray
        geometry,     // what a ray hit: position or normal
        environment,  // environment and suns
        absorption,   // transmittance of a solid's volume
        emission,     // emission of a surface
        light_sample, // NEE: radiance, pdf or weight
        bsdf_eval,    // BSDF value towards a light
        bsdf_sample,  // sampled direction, its pdf or weight
        roulette,     // weight of survivors
        sum,          // sum of contributions that are valid one by one
        light_path,   // a path from a light that reached this pixel; `sample` is its pass over the image
    };
    static constexpr int kinds = 5, places = 11;
    Kind kind = Kind::nan;
    Place place = Place::sum;
    int vertex = 0;
    bool operator==(const Fault&) const = default;
};
std::string_view to_string(Fault::Kind kind);   // "nan", "inf", "negative", "zero pdf", "overflowing pdf"
std::string_view to_string(Fault::Place place); // "camera", "light sample", ...

// A sample that the film dropped.
struct BadSample {
    enum class Cause : uint8_t { nan, infinite, negative };
    Cause cause = Cause::nan; // of its radiance
    int x = 0, y = 0;
    int64_t sample = 0;
    uint32_t seed = 0;
    Fault fault = {}; // origin of the invalid value
    bool operator==(const BadSample&) const = default;
};
// Why a film would drop this radiance, or nothing.
std::optional<BadSample::Cause> cause_to_drop(const Vec3d& radiance);
std::string_view to_string(BadSample::Cause cause); // "nan", "inf", "negative"
// "inf at light sample, vertex 2: pixel 3,4 sample 17".
std::string describe(const BadSample& sample);

// A firefly: `excess` is its luminance / sqrt(mean^2 + 0.01), the mean being that of the pixel's samples so far including this
// one; the square root limits fireflies in dark pixels, as in relmse.
struct Firefly {
    float excess = 0, luminance = 0; // nits
    int x = 0, y = 0;
    int64_t sample = 0;
    uint32_t seed = 0;
    bool operator==(const Firefly&) const = default;
};

struct Health {
    int64_t nan = 0, infinite = 0, negative = 0; // samples dropped, by cause
    // The same samples by fault: faults[kind][place].
    std::array<std::array<int64_t, Fault::places>, Fault::kinds> faults{};
    int64_t truncated = 0;             // paths ended at the maximal length, which darkens the image
    std::vector<BadSample> first;      // the first hundred in (sample, y, x) order
    std::vector<Firefly> fireflies;    // the worst hundred, worst first
    std::vector<uint32_t> dropped_map; // dropped samples of each pixel; empty if none
    int64_t dropped() const { return nan + infinite + negative; }
    int64_t count(Fault::Kind kind, Fault::Place place) const { return faults[size_t(kind)][size_t(place)]; }
};

} // namespace blush
