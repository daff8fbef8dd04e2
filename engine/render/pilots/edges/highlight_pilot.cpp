#include "render/pilots/edges/highlight_pilot.h"

#include "core/math.h"
#include "render/film/edges/edge_samples.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr uint32_t highlight_pilot_seed = 0x9b05688cu; // any; it only has to differ from those of images
// Cells are squares of pixels. One sample of each finds the smooth surfaces; the others look for lamps.
constexpr int most_cells = 16384, num_repeats = 65536, most_per_cell = 1024;
constexpr size_t samples_per_task = tile_capacity / most_copies; // that the kernel traces at once

class HighlightPilot {
public:
    HighlightPilot(const KernelContext& context, const Kernel& kernel, const Workers& workers,
                   std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted)
        : context_(context), kernel_(kernel), workers_(workers), scratch_(scratch), wanted_(wanted) {
        context_.seed = highlight_pilot_seed;
        restrict_to_emission(context_, tables_, longest_highlight_chain);
        side_ = std::max(1, int(std::ceil(std::sqrt(double(width()) * double(height()) / most_cells))));
        across_ = (width() + side_ - 1) / side_;
        down_ = (height() + side_ - 1) / side_;
        for (auto& s : scratch_)
            if (!s) s = std::make_unique<TileScratch>();
    }

    std::optional<Sightings> find();

private:
    int width() const { return int(context_.settings.width); }
    int height() const { return int(context_.settings.height); }
    PixelRect cell(int i) const {
        const int x = i % across_ * side_, y = i / across_ * side_;
        return {x, y, std::min(x + side_, width()), std::min(y + side_, height())};
    }
    // Sample `repeat` of a cell.
    ChainStart sample_of(int i, int repeat) const;
    // Traces the chains, of at most `longest` lobes, of `count` samples, sample_at(k). take(first, chains) receives what samples `first`,
    // first + 1, ... have met. False if not wanted any more.
    template <class SampleAt, class Take> bool trace(size_t count, int longest, const SampleAt& sample_at, const Take& take) const;
    // The cells in which a smooth surface turned the first sample, and those beside them.
    std::vector<int> near(const std::vector<uint8_t>& turned) const;

    KernelContext context_;
    const Kernel& kernel_;
    SceneTables tables_;
    int side_, across_, down_;
    const Workers& workers_;
    std::vector<std::unique_ptr<TileScratch>>& scratch_;
    const std::function<bool()>& wanted_;
};

ChainStart HighlightPilot::sample_of(int i, int repeat) const {
    // The R2 sequence (Roberts 2018) spreads the samples evenly over the cell.
    const int64_t index = i + int64_t(repeat) * most_cells;
    const auto pixel = [&](double step, int begin, int end) {
        const double at = double(index) * step;
        return float(std::min(begin + int((at - std::floor(at)) * (end - begin)), end - 1));
    };
    const PixelRect in = cell(i);
    return {pixel(0.7548776662466927, in.x0, in.x1), pixel(0.5698402909980532, in.y0, in.y1), uint32_t(index)};
}

template <class SampleAt, class Take>
bool HighlightPilot::trace(size_t count, int longest, const SampleAt& sample_at, const Take& take) const {
    KernelContext context = context_;
    context.settings.max_bounces = std::min(context.settings.max_bounces, longest);
    return workers_.for_each(int64_t((count + samples_per_task - 1) / samples_per_task), wanted_, [&](int64_t task, unsigned worker) {
        TileScratch& scratch = *scratch_[worker];
        if (!scratch.chains) scratch.chains = std::make_unique<ChainColumns>();
        ChainColumns& chains = *scratch.chains;
        const size_t first = size_t(task) * samples_per_task;
        chains.task = ChainTask::sight;
        chains.samples.clear();
        chains.sightings.clear();
        for (size_t k = first; k < std::min(first + samples_per_task, count); ++k) chains.samples.push_back(sample_at(k));
        chains.turned.resize(chains.samples.size());
        kernel_.trace_chains(context, {}, scratch);
        chains.task = ChainTask::emission;
        take(first, chains);
    });
}

std::vector<int> HighlightPilot::near(const std::vector<uint8_t>& turned) const {
    std::vector<int> cells;
    for (int i = 0; i < across_ * down_; ++i) {
        const int x = i % across_, y = i / across_;
        bool any = false;
        for (int v = std::max(0, y - 1); v <= std::min(down_ - 1, y + 1); ++v)
            for (int u = std::max(0, x - 1); u <= std::min(across_ - 1, x + 1); ++u) any = any || turned[size_t(v * across_ + u)];
        if (any) cells.push_back(i);
    }
    return cells;
}

std::optional<Sightings> HighlightPilot::find() {
    std::vector<uint8_t> turned(size_t(across_) * size_t(down_));
    // It does not count as one of the cell's samples: these are chosen by it.
    const auto take_turned = [&](size_t first, const ChainColumns& chains) {
        std::ranges::copy(chains.turned, turned.begin() + std::ptrdiff_t(first));
    };
    if (!trace(
            turned.size(), 1, [&](size_t k) { return sample_of(int(k), 0); }, take_turned))
        return std::nullopt;
    Sightings found;
    const std::vector<int> cells = near(turned);
    if (cells.empty()) return found;
    found.side = side_;
    for (const int i : cells) found.cells.push_back(cell(i));
    const auto repeats = size_t(std::clamp(int(size_t(num_repeats) / cells.size()), 1, most_per_cell));
    const size_t count = cells.size() * repeats;
    std::vector<std::vector<Sighting>> met((count + samples_per_task - 1) / samples_per_task);
    const auto take = [&](size_t first, const ChainColumns& chains) {
        for (const ChainSighting& c : chains.sightings) {
            const size_t k = (first + size_t(c.slot)) / repeats;
            const PixelRect in = found.cells[k];
            const double pixels = double(in.x1 - in.x0) * double(in.y1 - in.y0), all = double(width()) * double(height());
            const double of_image = pixels / (all * double(repeats)), share = double(c.share);
            const ChainStart& from = chains.samples[size_t(c.slot)];
            met[first / samples_per_task].push_back({int(from.x),
                                                     int(from.y),
                                                     c.apart,
                                                     luminance(c.light) / share,
                                                     {c.rate * share * of_image, c.light * (c.rate * of_image)},
                                                     share,
                                                     k,
                                                     from,
                                                     c});
        }
    };
    for (const auto& s : scratch_) s->camera_rays = s->bounce_rays = 0;
    if (!trace(
            count, longest_highlight_chain, [&](size_t k) { return sample_of(cells[k / repeats], int(k % repeats) + 1); }, take))
        return std::nullopt;
    for (const auto& s : scratch_) found.rays += double(s->camera_rays + s->bounce_rays);
    found.rays /= double(count);
    found.spacing = side_ / std::sqrt(double(repeats));
    for (const auto& part : met) found.all.insert(found.all.end(), part.begin(), part.end());
    return found;
}

} // namespace

std::optional<Sightings> find_small_highlights(const KernelContext& context, const Kernel& kernel, const Workers& workers,
                                               std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    return HighlightPilot(context, kernel, workers, scratch, wanted).find();
}

std::vector<Sighting> small_highlights(const Sightings& sightings, double most, double pixels) {
    SmallHighlights sighted = highlights_of(sightings);
    std::vector<Sighting> nearest = sightings.all;
    std::erase_if(nearest, [&](const Sighting& s) { return sighted.of(s.luminance).rate * pixels > most; });
    std::ranges::stable_sort(nearest, {}, &Sighting::apart);
    return nearest;
}

SmallHighlights highlights_of(const Sightings& sightings) {
    SmallHighlights all;
    for (const Sighting& s : sightings.all) all.add(s.luminance, s.band);
    return all;
}

} // namespace blush
