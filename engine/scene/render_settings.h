// What the command line and the Render panel set: one struct, one parser.
#pragma once

#include "core/result.h"
#include "scene/picture_region.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace blush {

// Which survival probability q a path has after a bounce, given its throughput beta relative to the camera.
// Russian roulette: Arvo and Kirk 1990. Survivors are divided by q, so every rule but biased_cut is unbiased.
struct Roulette {
    enum class Rule : uint8_t {
        off,        // q = 1
        max,        // q = largest component of beta
        luminance,  // q = luminance of beta
        sqrt,       // q = sqrt(largest component)
        constant,   // q = probability
        biased_cut, // ends paths with max(beta) < threshold and gives nothing back: wrong on purpose, for teaching
    };
    Rule rule = Rule::sqrt;
    int start = 3;           // first bounce at which it may end a path
    float floor = 0;         // q >= floor
    float cap = 1;           // q <= cap
    float probability = 0.8f; // constant
    float threshold = 0.1f;  // biased_cut
    bool operator==(const Roulette&) const = default;
};

// Limits samples to `limit` in their largest component: biased, it takes light away; the Frame says how much. Off by default.
struct Clamp {
    float limit = 0;  // nits; 0: off
    bool all = false; // of all light; else of what was scattered more than once
    bool operator==(const Clamp&) const = default;
};

enum class Strategy : uint8_t { mis, light, bsdf };
enum class PixelFilter : uint8_t { blackman_harris, box };
// Where samples get their numbers from: well distributed points, or independent random numbers.
enum class SampleNumbers : uint8_t { sobol, random };

constexpr int unlimited_bounces = -1;

struct RenderSettings {
    int width = 1280, height = 720; // pixels, 1 .. 65536
    float resolution_scale = 1;     // the window renders width x height times this
    // Stop rules, whichever comes first. 0 means no limit.
    int64_t spp = 64;
    double seconds = 0;
    double error = 0;               // estimated relMSE
    int64_t first_sample = 0;       // sample indices [first_sample, spp)
    uint32_t seed = 0;
    int max_bounces = unlimited_bounces;
    Roulette roulette = {};
    Strategy strategy = Strategy::mis;
    PixelFilter filter = PixelFilter::blackman_harris;
    SampleNumbers sampler = SampleNumbers::sobol;
    bool energy_compensation = false;
    bool adaptive = false;          // spp is a mean: more samples where the noise is. Starts at sample 0
    int reuse = 1;                  // pixels that share their second path vertices: 4, 8, 16 or, alone, 1
    Clamp clamp = {};
    PictureRegion region = {};      // alone is rendered, evenly whatever adaptive says; the rest of the picture stays empty
    bool operator==(const RenderSettings&) const = default;
};

// What the command line and the window begin with. RenderSettings{} is the plain path tracer that is taught and tested against; this adds what
// gives less error for the time on the scenes measured (README).
RenderSettings recommended_settings();

// As they are carried out: a region is not sampled adaptively, so that it is the same as in a whole picture that is not.
RenderSettings carried_out(RenderSettings settings);

// True if an image accumulated under `before` is still the one `after` asks for: they differ in stop rules alone.
bool same_image(const RenderSettings& before, const RenderSettings& after);

// "sqrt,start=3", "constant=0.7,start=1", "biased-cut=0.05", ... as in `blush render --roulette`.
Result<Roulette> parse_roulette(std::string_view text);
std::string to_string(const Roulette& roulette);
// "off", "10" (light scattered more than once), "10,all".
Result<Clamp> parse_clamp(std::string_view text);
std::string to_string(const Clamp& clamp);
Result<int> parse_max_bounces(std::string_view text); // a number or "unlimited"
std::string max_bounces_text(int max_bounces);
Result<int> parse_reuse(std::string_view text); // "4", "8", "16" or "off"
std::string_view reuse_text(int reuse); // empty for another number
Result<Strategy> parse_strategy(std::string_view text);
std::string_view to_string(Strategy strategy);
Result<PixelFilter> parse_filter(std::string_view text);
std::string_view to_string(PixelFilter filter);
Result<SampleNumbers> parse_sampler(std::string_view text);
std::string_view to_string(SampleNumbers sampler);

} // namespace blush
