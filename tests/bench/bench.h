// Common parts of the benchmark cases. A case measures one thing on several scenes and returns its figures as JSON.
#pragma once

#include "tests/bench/bench_scene.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <functional>
#include <stdexcept>
#include <vector>

namespace blush::bench {

using Json = nlohmann::ordered_json;

struct Options {
    std::vector<BenchScene> scenes;
    unsigned threads = 2;                           // the largest number that is measured
    int rounds = 9;                                 // of each interleaved comparison; medians are reported
    int edits = 40;                                 // of each kind
    int reference_samples = 4096;                   // of the reference images for errors
    std::filesystem::path cache;                    // folder that caches reference images; empty: no cache
    std::string variant;                            // the only variant of path reuse and adaptive sampling to run; empty: all
    int64_t max_samples = 64;                       // per pixel, maximum of a series
    double max_seconds = 10;                        // after an edit
    std::vector<std::filesystem::path> peer_images; // JSON of another renderer's images, for the case "quality"
    std::string only;                               // part of the names of the scenes to measure
    std::string edit;                               // the only kind of edit of the case "quality"; empty: all
    std::filesystem::path scene_folder;             // of the peer comparison; empty: not given
    std::string against;                            // another build of blush, which whole processes are compared with; empty: none
    bool quick = false;                             // for testing the benchmark, not for figures
};

Json run_rate(const Options& options);
Json run_kernels(const Options& options);
Json run_latency(const Options& options);
Json run_setup(const Options& options);
Json run_startup(const Options& options);
Json run_big_scenes(const Options& options);
Json run_denoise(const Options& options);
Json run_estimate(const Options& options);
Json run_error_coverage(const Options& options);
Json run_recorder(const Options& options);
Json run_light_edits(const Options& options);
Json run_many_lights(const Options& options);
Json run_mix(const Options& options);
Json run_textures(const Options& options);
Json run_time_slider(const Options& options);
Json run_image_quality(const Options& options);
Json run_after_edits(const Options& options);
Json run_quality(const Options& options);

using Clock = std::chrono::steady_clock;
inline double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

// Cost of work. CPU seconds of all cores are independent of other load on the machine.
struct Cost {
    double wall_seconds = 0, core_seconds = 0;
};
Cost cost_of(const std::function<void()>& work);

// The value. Throws std::runtime_error with the text of the error if there is none.
template <class T> T checked(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().text());
    return *std::move(result);
}

// Folder with the weights of the denoiser: $BLUSH_WEIGHTS, or that of the build tree.
std::filesystem::path weights_folder();

// The smallest value that at least the share `p` of all values does not exceed (nearest rank); `values` must not be empty.
double quantile(std::vector<double> values, double p);
double median(std::vector<double> values);
// Three significant digits: the precision of a shared machine.
double rounded(double value);

} // namespace blush::bench
