#include "render/pilots/edges/highlight_samples.h"

#include <algorithm>
#include <functional>

namespace blush {
namespace {

// Of the work of the camera's paths. The pilot knows the noise of highlights well, but hardly that of rare paths: where these make most of
// the noise, more samples of the emission are spent in vain.
constexpr double largest_added_work = 0.5;

// More samples of the emission in a pixel, or in the pixels of a cell that are not measured.
struct Step {
    MeasuredPixel* pixel = nullptr;
    FaintCell* cell = nullptr;
    int samples = 0;
    double gain = 0, relative_gain = 0, work = 0; // of the image

    double worth(const ImageNoise& of) const { return (gain / of.mse + relative_gain / of.relmse) / work; }
};

// The steps of a pixel.
void add_steps(MeasuredPixel& pixel, double share, const ImageNoise& before, std::vector<Step>& steps) {
    // Each step is the best of those that are left, so the steps of a pixel are taken in their order.
    for (int samples = 0; samples < bright_highlight_samples;) {
        Step best;
        for (const int more : {faint_highlight_samples, highlight_samples, bright_highlight_samples}) {
            const double gain = (pixel.variance_with(samples) - pixel.variance_with(more)) * share;
            if (more <= samples || !(gain > 0)) continue;
            const int added = samples == 0 ? more + 1 : more - samples; // one for what the path has found
            const Step step{&pixel, nullptr, more, gain, gain / pixel.scale(), added * pixel.rays_per_sample() * share};
            if (!best.pixel || step.worth(before) > best.worth(before)) best = step;
        }
        if (!best.pixel) break;
        steps.push_back(best);
        samples = best.samples;
    }
}

} // namespace

double relative_to_variance(std::span<const MeasuredPixel> measured) {
    double variance = 0, relative = 0;
    for (const MeasuredPixel& pixel : measured) {
        variance += pixel.path_variance;
        relative += pixel.path_variance / pixel.scale();
    }
    return variance > 0 ? relative / variance : 0;
}

void choose_highlight_samples(std::vector<MeasuredPixel>& measured, std::vector<FaintCell>& cells, double pixels,
                              const ImageNoise& before) {
    const double share = 1 / pixels;
    std::vector<Step> steps;
    for (MeasuredPixel& pixel : measured) add_steps(pixel, share, before, steps);
    const double relative = relative_to_variance(measured);
    for (FaintCell& cell : cells) {
        const double gain = cell.path_variance - cell.variance;
        if (!(gain > 0) || !(cell.pixels > 0)) continue;
        const double work = (faint_highlight_samples + 1) * cell.rays * cell.pixels * share;
        steps.push_back({nullptr, &cell, faint_highlight_samples, gain, gain * relative, work});
    }
    std::ranges::stable_sort(steps, std::ranges::greater{}, [&](const Step& s) { return s.worth(before); });
    ImageNoise now = before;
    double best = now.cost();
    size_t taken = 0;
    for (size_t k = 0; k < steps.size(); ++k) {
        now.mse -= steps[k].gain;
        now.relmse -= steps[k].relative_gain;
        now.work += steps[k].work;
        if (now.work - before.work > largest_added_work * (before.work - before.light_path_work)) break;
        if (now.cost() < best) best = now.cost(), taken = k + 1;
    }
    for (size_t k = 0; k < taken; ++k) {
        if (steps[k].cell) steps[k].cell->taken = true;
        if (steps[k].pixel) steps[k].pixel->samples = std::max(steps[k].pixel->samples, steps[k].samples);
    }
}

} // namespace blush
