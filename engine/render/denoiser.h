// Image + albedo + normal -> image, by the learned networks of Open Image Denoise. Loads nothing before the first call.
#pragma once

#include "core/result.h"
#include "render/ledger.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace blush {

enum class DenoiseQuality : uint8_t {
    fast, // the small network
    base, // the base network, albedo and normal as they are
    high, // the base network after albedo and normal were denoised on their own: sharpest, three times the work
};
constexpr int denoise_qualities = 3;
enum class DenoisePrecision : uint8_t {
    automatic, // bfloat16 where the processor computes with it, else float32
    float32,
    bfloat16, // an error where the processor has none
};

// Three interleaved components of each pixel, `stride` floats apart, top row first. Empty: not there.
struct PixelView {
    std::span<const float> values = {};
    int stride = 3;
};

struct DenoiseInput {
    int width = 0, height = 0; // from 1x1; any size
    PixelView color;           // scene-linear, any value: what is not finite, negative or beyond 65504 / exposure scale is sanitised
    PixelView albedo = {};     // optional, [0, 1]
    PixelView normal = {};     // optional, world space, [-1, 1]; there is no network for one of the two alone: then neither is read
};

struct DenoiseOptions {
    DenoiseQuality quality = DenoiseQuality::fast;
    DenoisePrecision precision = DenoisePrecision::automatic;
    // What colour is multiplied with before the network sees it. Empty: measured from the image. A picture that refines must
    // keep the scale of its first denoised image, or its brightness pumps.
    std::optional<float> exposure_scale = {};
    // The factor within which the measured scale may differ from that one before it is taken in its place: a picture after an edit
    // then keeps the scale of the one before, unless the light has really changed. Infinite: the scale above holds whatever is measured.
    float exposure_tolerance = std::numeric_limits<float>::infinity();
    // Of the memory that a call works in, weights and images aside. Images that need more are done in overlapping tiles.
    uint64_t memory_bytes = uint64_t(3) << 29;
};

struct Denoised {
    std::vector<float> rgb; // width * height * 3, scene-linear, finite, >= 0, top row first; shares nothing with the input

    float exposure_scale = 1;
    int64_t sanitised = 0; // pixels whose colour was NaN, infinite, negative or too large for the network
    double mean_before = 0; // mean luminance of the input, where it is finite, and of `rgb`: the denoiser's change of mean energy
    double mean_after = 0;
    std::string network;    // "rt_hdr_alb_nrm_small"
    std::string precision;  // "float32" or "bfloat16"
    int tiles = 1;
    double seconds = 0;
};

// Keeps weights, compiled networks and memory between calls. One call at a time; any thread may make it.
// The result does not depend on the number of threads.
class Denoiser {
public:
    // `weights`: the folder with the *.tza files; not looked at before the first call. 0 threads: one per core.
    // At low priority, the thread that constructs gets it as well (see Workers).
    explicit Denoiser(std::filesystem::path weights, unsigned threads = 0, bool low_priority = false);
    ~Denoiser();
    Denoiser(const Denoiser&) = delete;
    Denoiser& operator=(const Denoiser&) = delete;

    // Asked often, from many threads: nothing is returned soon after `wanted` says false.
    // Errors: weights absent or damaged, spans too short for the size, memory too small for the smallest tile, a precision that this
    // processor does not have. `progress`, if there is one, is told of the share that is done, layer by layer, on the caller's thread; 1 at
    // the end.
    Result<std::optional<Denoised>> denoise(const DenoiseInput& input, const DenoiseOptions& options,
                                            const std::function<bool()>& wanted = {}, const std::function<void(double)>& progress = {});
    // Frees everything but the weights; the next call builds it again.
    void release();

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Are all the weights that denoise() may want there? Reads none of them. The error names the first that is missing.
Result<void> find_denoiser_weights(const std::filesystem::path& weights);

// A line for the networks of each quality: were they loaded, and the bytes of their files, where those are there.
Ledger denoiser_ledger(const std::filesystem::path& weights, const std::array<bool, denoise_qualities>& loaded);

} // namespace blush
