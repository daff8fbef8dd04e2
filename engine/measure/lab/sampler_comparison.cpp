#include "measure/lab/sampler_comparison.h"

#include "core/math.h"
#include "core/sampler.h"
#include "measure/lab/lab_settings.h"
#include "measure/statistics/paired_statistics.h"
#include "render/integrator/estimator.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

constexpr size_t stage_count = compared_sample_counts.size();

// Luminances of one image after each of the numbers of samples.
using Stages = std::array<std::vector<double>, stage_count>;

struct SamplerSide {
    std::unique_ptr<Renderer> renderer;
    RenderSettings settings;
    Frame frame;
    std::array<Trials, stage_count> mse; // of pairs

    void begin(const RendererOptions& options, const RenderSettings& s, SamplerType sampler) {
        if (!renderer) renderer = std::make_unique<Renderer>(options);
        settings = s;
        settings.sampler = sampler;
        mse = {};
    }
    bool render(const Scene& scene, uint32_t seed, const std::function<bool()>& wanted, Stages& stages) {
        settings.seed = seed;
        renderer->update(scene, settings);
        renderer->clear();
        int64_t samples = 0;
        for (size_t k = 0; k < stage_count; ++k) {
            if (!renderer->render(samples, compared_sample_counts[k] - samples, wanted)) return false;
            samples = compared_sample_counts[k];
            renderer->resolve(frame);
            stages[k].resize(frame.rgba.size() / 4);
            for (size_t i = 0; i < stages[k].size(); ++i)
                stages[k][i] = luminance(Vec3d{double(frame.rgba[4 * i]), double(frame.rgba[4 * i + 1]), double(frame.rgba[4 * i + 2])});
        }
        return true;
    }
    void add(const Stages& a, const Stages& b) {
        for (size_t k = 0; k < stage_count; ++k) {
            double sum = 0;
            for (size_t i = 0; i < a[k].size(); ++i) sum += 0.5 * (a[k][i] - b[k][i]) * (a[k][i] - b[k][i]);
            if (!a[k].empty()) mse[k].add(sum / double(a[k].size()));
        }
    }
};

// 95 % interval of a mean over pairs, or of the ratio of two, to a power: by the delta method for the logarithm.
Interval interval_of(double value, double relative_error, int64_t pairs, double power) {
    constexpr int64_t least_pairs = 5; // fewer say hardly anything of their scatter
    if (pairs < least_pairs || !(value > 0)) return {};
    const double root = std::pow(value, power), width = std::abs(power) * student_95(pairs - 1) * relative_error;
    return {true, root, root * std::exp(-width), root * std::exp(width)};
}
double relative_error(const Trials& t) { return t.mean() > 0 ? t.error() / t.mean() : 0; }
Interval rmse_of(const Trials& mse) { return interval_of(mse.mean(), relative_error(mse), mse.count(), 0.5); }
Interval ratio_of(const Trials& a, const Trials& b) {
    return interval_of(b.mean() > 0 ? a.mean() / b.mean() : 0, std::hypot(relative_error(a), relative_error(b)), a.count(), 1);
}

} // namespace

std::vector<SamplePoint> sample_points(SamplerType type, int x, int y, uint32_t seed, uint32_t dimension, int count) {
    std::vector<SamplePoint> points;
    for (int s = 0; s < count; ++s) {
        const uint32_t half = uint32_t(s % 2), index = uint32_t(s / 2), key = randomisation(seed, half);
        const Sampler<float> sampler = type == SamplerType::sobol ? pixel_sampler<float>(uint32_t(x), uint32_t(y), key, index)
                                                                  : independent_sampler<float>(uint32_t(x), uint32_t(y), key, index);
        const Pair<float> pair = sampler.pair(dimension);
        points.push_back({pair.x(), pair.y(), int(half)});
    }
    return points;
}

std::string sampler_dimension_name(uint32_t dimension) {
    if (dimension == 0) return "pixel filter";
    if (dimension == 1) return "lens";
    constexpr const char* uses[] = {"light", "BSDF direction", "BSDF lobe and roulette"};
    static_assert(std::size(uses) == dimensions_per_scatter);
    const uint32_t scatter = dimension - first_scatter_dimension;
    return fmt::format("{}, bounce {}", uses[scatter % dimensions_per_scatter], scatter / dimensions_per_scatter);
}

struct SamplerComparison::State {
    RendererOptions options;
    Scene scene;
    std::array<SamplerSide, 2> sides;
    SamplerReport report;

    void report_errors() {
        for (size_t k = 0; k < stage_count; ++k) {
            for (size_t i = 0; i < sides.size(); ++i) report.sides[i][k] = rmse_of(sides[i].mse[k]);
            report.gains[k] = ratio_of(sides[0].mse[k], sides[1].mse[k]);
        }
    }
};

SamplerComparison::SamplerComparison(const RendererOptions& options) : state_(std::make_unique<State>()) { state_->options = options; }
SamplerComparison::~SamplerComparison() = default;

void SamplerComparison::begin(const Scene& scene, const RenderSettings& settings, int longest) {
    State& s = *state_;
    const RenderSettings small = plain_lab_settings(settings, longest);
    s.scene = scene;
    for (size_t i = 0; i < s.sides.size(); ++i) s.sides[i].begin(s.options, small, compared_samplers[i]);
    s.report = {};
    s.report.width = small.width;
    s.report.height = small.height;
}

bool SamplerComparison::round(const std::function<bool()>& wanted) {
    State& s = *state_;
    const auto seed = uint32_t(2 * s.report.pairs);
    std::array<Stages, 2> images;
    for (SamplerSide& side : s.sides) {
        for (uint32_t k = 0; k < 2; ++k)
            if (!side.render(s.scene, seed + k, wanted, images[k])) return false;
        side.add(images[0], images[1]);
    }
    ++s.report.pairs;
    s.report_errors();
    return true;
}

const SamplerReport& SamplerComparison::report() const { return state_->report; }

} // namespace blush
