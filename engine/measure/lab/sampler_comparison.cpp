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

// 95 % interval of a mean over pairs.
Interval interval_of(const Trials& t) {
    if (t.count() < 2 || !(t.mean() > 0)) return {};
    const double half = student_95(t.count() - 1) * t.error();
    return {true, t.mean(), std::max(0.0, t.mean() - half), t.mean() + half};
}
Interval root_of(const Interval& mse) { return {mse.known, std::sqrt(mse.value), std::sqrt(mse.low), std::sqrt(mse.high)}; }

// Of independent means, by the delta method for the logarithm of their ratio.
Interval ratio_of(const Trials& a, const Trials& b) {
    if (a.count() < 2 || !(a.mean() > 0) || !(b.mean() > 0)) return {};
    const double ratio = a.mean() / b.mean(), width = student_95(a.count() - 1) * std::hypot(a.error() / a.mean(), b.error() / b.mean());
    return {true, ratio, ratio * std::exp(-width), ratio * std::exp(width)};
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
            for (size_t i = 0; i < sides.size(); ++i) report.sides[i][k] = root_of(interval_of(sides[i].mse[k]));
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
