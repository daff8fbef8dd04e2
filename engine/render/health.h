// What could not be added to a picture, why, and what stands out in it: samples named by (pixel, sample, seed), each of which can be traced
// again.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// What was wrong first in a sample, where in the estimator it arose, and at which vertex of the path.
struct Fault {
    enum class Kind : uint8_t { nan, infinite, negative, zero_pdf, overflowing_pdf };
    enum class Place : uint8_t {
        camera,       // the ray that the path begins with
        geometry,     // what a ray hit: position or normal
        environment,  // light from beyond all surfaces
        absorption,   // what a solid's volume let through
        emission,     // light that a surface gives off
        light_sample, // next-event estimation: light, density or weight
        bsdf_eval,    // the BSDF towards a light
        bsdf_sample,  // the scattered direction, its density or weight
        roulette,     // the weight of survivors
        sum,          // of contributions that were sound one by one
    };
    static constexpr int kinds = 5, places = 10;
    Kind kind = Kind::nan;
    Place place = Place::sum;
    int vertex = 0;
    bool operator==(const Fault&) const = default;
};
std::string_view to_string(Fault::Kind kind);   // "nan", "inf", "negative", "zero pdf", "overflowing pdf"
std::string_view to_string(Fault::Place place); // "camera", "light sample", ...

// A sample that could not be added to the film.
struct BadSample {
    enum class Cause : uint8_t { nan, infinite, negative };
    Cause cause = Cause::nan; // what its radiance is
    int x = 0, y = 0;
    int64_t sample = 0;
    uint32_t seed = 0;
    Fault fault = {}; // how it came to that
    bool operator==(const BadSample&) const = default;
};
std::string_view to_string(BadSample::Cause cause); // "nan", "inf", "negative"
// "inf at light sample, vertex 2: pixel 3,4 sample 17".
std::string describe(const BadSample& sample);

// A sample that stands out of its pixel: `excess` is its luminance / sqrt(mean^2 + 0.01), the mean being that of the pixel's samples up to
// this one and itself; the square root keeps dark pixels from being full of them, as it does in relmse.
struct Firefly {
    float excess = 0, luminance = 0; // nits
    int x = 0, y = 0;
    int64_t sample = 0;
    uint32_t seed = 0;
    bool operator==(const Firefly&) const = default;
};

struct Health {
    int64_t nan = 0, infinite = 0, negative = 0; // samples dropped, by cause
    // The same samples by what was wrong first: faults[kind][place].
    std::array<std::array<int64_t, Fault::places>, Fault::kinds> faults{};
    int64_t truncated = 0;             // paths ended at the longest length there is, which darkens
    std::vector<BadSample> first;      // the first hundred in (sample, y, x) order
    std::vector<Firefly> fireflies;    // the worst hundred, worst first
    std::vector<uint32_t> dropped_map; // dropped samples of each pixel; empty if there are none
    int64_t dropped() const { return nan + infinite + negative; }
    int64_t count(Fault::Kind kind, Fault::Place place) const { return faults[size_t(kind)][size_t(place)]; }
};

} // namespace blush
