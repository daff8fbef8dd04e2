// Denoises an image with albedo and normal by the networks of Open Image Denoise. Loads nothing before the first call.
#pragma once

#include "core/result.h"
#include "render/compile/feature_report.h"
#include "render/denoise/pixel_view.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace blush {

enum class DenoiseQuality : uint8_t {
    fast, // the small network
    base, // the base network, albedo and normal unfiltered
    high, // the base network with albedo and normal prefiltered: sharpest, three times the work
};
constexpr int denoise_qualities = 3;
enum class DenoisePrecision : uint8_t {
    automatic, // bfloat16 if the processor supports it, else float32
    float32,
    bfloat16, // error if the processor does not support it
};

struct DenoiseInput {
    int width = 0, height = 0; // from 1x1; any size
    PixelView color;           // scene-linear, any value: non-finite, negative or > 65504 / exposure scale is sanitised
    PixelView albedo = {};     // optional, [0, 1]
    PixelView normal = {};     // optional, world space, [-1, 1]; no network uses only one of the two: then both are ignored
};

struct DenoiseOptions {
    DenoiseQuality quality = DenoiseQuality::fast;
    DenoisePrecision precision = DenoisePrecision::automatic;
    // Factor for colour before the network. Empty: measured from the image. A refining image must keep the scale of its first
    // denoised version, or its brightness flickers.
    std::optional<float> exposure_scale = {};
    // The given scale is kept while the measured scale differs from it by at most this factor. An edited image then keeps its
    // scale unless the light really changed. Infinite: the given scale is always used.
    float exposure_tolerance = std::numeric_limits<float>::infinity();
    // Limit of working memory, without weights and images. Larger images are split into overlapping tiles.
    uint64_t memory_bytes = uint64_t(3) << 29;
};

struct Denoised {
    std::vector<float> rgb; // width * height * 3, scene-linear, finite, >= 0, top row first; a copy, never the input

    float exposure_scale = 1;
    int64_t sanitised = 0;  // pixels whose colour was NaN, infinite, negative or too large for the network
    double mean_before = 0; // mean luminance of the input (finite pixels) and of `rgb`: the denoiser's change of mean energy
    double mean_after = 0;
    bool bias_corrected = false; // by correct_bias() afterwards
    std::string network;         // "rt_hdr_alb_nrm_small"
    std::string precision;       // "float32" or "bfloat16"
    int tiles = 1;
    double seconds = 0;
    double seconds_of_preparation = 0; // of these: reading weights, building networks, allocating memory
};

// Keeps weights, compiled networks and memory between calls. One call at a time; any thread may make it.
// The result does not depend on the number of threads.
class Denoiser {
public:
    // `weights`: the folder with the *.tza files; not read before the first call. 0 threads: one per core. low_priority also
    // applies to the constructing thread (see Workers).
    explicit Denoiser(std::filesystem::path weights, unsigned threads = 0, bool low_priority = false);
    ~Denoiser();
    Denoiser(const Denoiser&) = delete;
    Denoiser& operator=(const Denoiser&) = delete;

    // `wanted` is called often, from many threads; returns empty soon after it returns false.
    // Errors: weights missing or damaged, spans too short for the size, not enough memory for
    // the smallest tile, a precision that this processor does not support. `progress` (optional)
    // gets the completed fraction after each layer, on the caller's thread; 1 at the end.
    Result<std::optional<Denoised>> denoise(const DenoiseInput& input, const DenoiseOptions& options,
                                            const std::function<bool()>& wanted = {}, const std::function<void(double)>& progress = {});
    // Frees everything but the weights; the next call rebuilds it.
    void release();

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Checks that all weights that denoise() may need exist, without reading them. The error names the first missing file.
Result<void> find_denoiser_weights(const std::filesystem::path& weights);

// One line for the networks of each quality: whether they were loaded, and the size of their files if these exist.
FeatureReport denoiser_feature_report(const std::filesystem::path& weights, const std::array<bool, denoise_qualities>& loaded);

} // namespace blush
