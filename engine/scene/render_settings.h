// Render settings, shared by the command line and the Render panel, and their parsers.
#pragma once

#include "core/result.h"
#include "scene/image_region.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace blush {

// Russian roulette: rule for the survival probability q of a path after a bounce, given its throughput beta from the camera on.
// Arvo and Kirk 1990. Survivors are divided by q, so every rule except biased_cut is unbiased. A pilot learns what `adjoint`,
// `efficiency` and `splitting` need (render/roulette/adjoint_field.h); the first sample is rendered by `sqrt` instead of these and of
// `automatic`.
struct Roulette {
    enum class Rule : uint8_t {
        automatic,  // of sqrt, adjoint and efficiency the one with the least variance x work, as a pilot measures
        off,        // q = 1
        max,        // q = largest component of beta
        luminance,  // q = luminance of beta
        sqrt,       // q = sqrt(largest component)
        constant,   // q = probability
        adjoint,    // q = luminance of beta x light that paths find behind this place / luminance of the pixel
        efficiency, // q that gives the image the least variance x work
        splitting,  // the same, and paths that are worth it go on in several copies (EARS; path_splitting.h)
        biased_cut, // ends paths with max(beta) < threshold without compensation: biased on purpose, for teaching
    };
    Rule rule = Rule::sqrt;
    int start = 3;            // first bounce at which it may end a path
    float floor = 0;          // q >= floor
    float cap = 1;            // q <= cap
    float probability = 0.8f; // constant
    float threshold = 0.1f;   // biased_cut
    // True if the rule needs a pilot.
    bool learns() const { return rule == Rule::automatic || rule == Rule::adjoint || rule == Rule::efficiency || rule == Rule::splitting; }
    bool operator==(const Roulette&) const = default;
};

// Clamping: limits the largest component of a sample. Biased: it removes energy; Frame reports how much. Off by default.
struct Clamp {
    float limit = 0;  // nits; 0: off
    bool all = false; // all light; else only indirect light (scattered more than once)
    bool operator==(const Clamp&) const = default;
};

enum class Strategy : uint8_t { mis, light, bsdf };
// The heuristic of MIS: how much of a direction that NEE and BSDF sampling both find each contributes, by their densities p (Veach 1997,
// section 9.2). Unbiased by all of them. For comparison: the default has the least error nearly everywhere.
struct MisHeuristic {
    enum class Rule : uint8_t {
        power,   // p^exponent; exponent 1 is the balance heuristic
        cutoff,  // p, or 0 below threshold times the larger density
        maximum, // all to the larger density
    };
    static constexpr int max_exponent = 8;
    Rule rule = Rule::power;
    int exponent = 2;       // power: 1 .. max_exponent
    float threshold = 0.1f; // cutoff: 0 .. 1
    bool operator==(const MisHeuristic&) const = default;
};
// Which ways to find caustics an image may use; pilots decide whether they pay. Each but `off` also samples directions into the objects
// that cast them (caustic_guiding.h). All are unbiased. For comparison: `automatic` is best.
enum class CausticStrategy : uint8_t {
    automatic, // all
    off,       // NEE and BSDF sampling alone
    guiding,   // path guiding
    light_paths,
    manifold, // manifold sampling
};
enum class PixelFilter : uint8_t { blackman_harris, box };
// Sampler: scrambled Sobol points, or independent random numbers.
enum class SamplerType : uint8_t { sobol, random };

constexpr int unlimited_bounces = -1;

struct RenderSettings {
    int width = 1280, height = 720; // pixels, 1 .. 65536
    float resolution_scale = 1;     // factor on width x height in the window
    // Stop rules; the first that is met ends the render. 0 means no limit.
    int64_t spp = 64;
    double seconds = 0;
    double error = 0;         // estimated relMSE
    int64_t first_sample = 0; // sample indices [first_sample, spp)
    uint32_t seed = 0;
    int max_bounces = unlimited_bounces;
    Roulette roulette = {};
    Strategy strategy = Strategy::mis;
    MisHeuristic heuristic = {}; // only the default can be combined with strategies for caustics; needs Strategy::mis
    CausticStrategy caustics = CausticStrategy::automatic;
    PixelFilter filter = PixelFilter::blackman_harris;
    SamplerType sampler = SamplerType::sobol;
    bool energy_compensation = false;
    bool mis_compensation = false; // light sampling leaves out what BSDF sampling covers (environment_table.h); needs Strategy::mis
    bool adaptive = false;         // adaptive sampling; spp is then the mean. Requires first_sample = 0
    bool smooth_edges = false;     // more camera rays at edges of visible emitters, where a pilot finds that they pay (edge_choice.h)
    int reuse = 1;                 // path reuse: pixels that share their second path vertices: 4, 8, 16, 1 (off), or reuse_auto
    Clamp clamp = {};
    ImageRegion region = {}; // only this is rendered, without adaptive sampling; the rest of the image stays empty
    bool operator==(const RenderSettings&) const = default;
};

// Defaults of the command line and the window. RenderSettings{} is the plain path tracer for teaching and tests; this adds the
// options that reduce the error at equal time on the measured scenes (README).
RenderSettings recommended_settings();

// Effective settings: a region turns adaptive sampling off, so that its pixels equal those of the whole image without adaptive
// sampling.
RenderSettings effective_settings(RenderSettings settings);
// The size times the resolution scale, which becomes 1.
RenderSettings at_film_size(RenderSettings settings);

// True if samples accumulated with `before` are valid for `after`: they differ in stop rules only.
bool same_image(const RenderSettings& before, const RenderSettings& after);

// "sqrt,start=3", "constant=0.7,start=1", "biased-cut=0.05", ... as in `blush render --roulette`.
Result<Roulette> parse_roulette(std::string_view text);
std::string to_string(const Roulette& roulette);
// "off", "10" (light scattered more than once), "10,all".
Result<Clamp> parse_clamp(std::string_view text);
std::string to_string(const Clamp& clamp);
Result<int> parse_max_bounces(std::string_view text); // a number or "unlimited"
std::string max_bounces_text(int max_bounces);
Result<int> parse_reuse(std::string_view text); // "auto", "off", "4", "8" or "16"
std::string_view reuse_text(int reuse);         // empty for other numbers
Result<Strategy> parse_strategy(std::string_view text);
std::string_view to_string(Strategy strategy);
// "power=2", "balance", "cutoff=0.1", "maximum".
Result<MisHeuristic> parse_heuristic(std::string_view text);
std::string to_string(const MisHeuristic& heuristic);
Result<CausticStrategy> parse_caustics(std::string_view text);
std::string_view to_string(CausticStrategy caustics);
Result<PixelFilter> parse_filter(std::string_view text);
std::string_view to_string(PixelFilter filter);
Result<SamplerType> parse_sampler(std::string_view text);
std::string_view to_string(SamplerType sampler);

} // namespace blush
