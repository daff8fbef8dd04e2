// Comparison of samplers (Sobol points, random numbers): their points, and the error of an image with each.
#pragma once

#include "measure/statistics/intervals.h"
#include "render/renderer.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace blush {

// The order of SamplerReport::sides.
constexpr std::array<SamplerType, 2> compared_samplers{SamplerType::random, SamplerType::sobol};
constexpr std::array<int, 5> compared_sample_counts{1, 4, 16, 64, 256}; // per pixel

struct SamplePoint {
    float x = 0, y = 0; // [0, 1)
    int half = 0;       // 0, 1: the half buffer that the sample belongs to
};
// A pair of dimensions of the first `count` samples of a pixel, as the film uses them. `dimension`: number of the pair
// (sampler_dimension_name()).
std::vector<SamplePoint> sample_points(SamplerType sampler, int x, int y, uint32_t seed, uint32_t dimension, int count);
// What the path tracer uses these two numbers for: "pixel filter", "light, bounce 0".
std::string sampler_dimension_name(uint32_t dimension);

// Root of the mean squared error of the pixels' luminance, nits, for compared_sample_counts; not known before five pairs of images.
using SamplerErrors = std::array<Interval, compared_sample_counts.size()>;

struct SamplerReport {
    int64_t pairs = 0; // of images, of each sampler
    int width = 0, height = 0;
    std::array<SamplerErrors, 2> sides; // compared_samplers
    // Ratio of the mean squared errors, random numbers over Sobol points: how many times the samples random numbers need for the same
    // error, since theirs falls with their number.
    SamplerErrors gains;
};

// Renders pairs of images that differ in the seed alone: half their mean squared difference is the variance of a pixel, without any
// reference image. Both samplers are unbiased, so the variance is the mean squared error. Adaptive sampling, path reuse, strategies for
// caustics, smooth edges and clamping are off, as they change the samples.
class SamplerComparison {
public:
    explicit SamplerComparison(const RendererOptions& options);
    ~SamplerComparison();

    // Restarts. The image is scaled to at most `longest` pixels on its longer side. Throws as Renderer::update does.
    void begin(const Scene& scene, const RenderSettings& settings, int longest = 64);
    // One pair of images with each sampler. False if `wanted` (called often, from many threads) returned false: the round is then
    // discarded, and no other round can follow.
    bool round(const std::function<bool()>& wanted = {});
    const SamplerReport& report() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
