#include "render/film/film_merger.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace blush {
namespace {

// Everything but planes and health.
FilmState head_of(const FilmState& state) {
    FilmState head;
    head.width = state.width;
    head.height = state.height;
    head.first_sample = state.first_sample;
    head.samples = state.samples;
    head.seconds = state.seconds;
    head.first_is_rough = state.first_is_rough;
    head.shares = state.shares;
    head.reuse_pilot = state.reuse_pilot;
    head.highlights = state.highlights;
    head.rays = state.rays;
    head.path_counts = state.path_counts;
    head.truncated = state.truncated;
    head.mix = state.mix;
    return head;
}

void add_counts(std::vector<PathCounts>& counts, const std::vector<PathCounts>& more) {
    counts.resize(std::max(counts.size(), more.size()));
    for (size_t k = 0; k < more.size(); ++k) counts[k] += more[k];
}

} // namespace

Result<void> FilmMerger::add(const FilmState& part) {
    if (state_.samples == 0) {
        if (const auto loaded = load_new_film(film_, part, settings_); !loaded) return loaded.error();
        state_ = head_of(part);
        pilot_.restore(part.marked);
        measure_pilot();
        return {};
    }
    const int64_t end = state_.first_sample + state_.samples;
    if (part.first_sample < end) return Error{"", fmt::format("both files contain sample {}", part.first_sample), ""};
    if (part.first_sample > end) return Error{"", fmt::format("samples {} to {} are in neither file", end, part.first_sample - 1), ""};
    // Its first sample has another estimator than that of a longer render.
    if (state_.first_is_rough) return Error{"", "the first sample was rendered alone: render it with --samples 0:1", ""};
    if (!state_.shares[0].empty() && !part.shares[0].empty() && state_.shares != part.shares)
        return Error{"", "was rendered with another allocation of adaptive sampling", ""};
    if (const auto added = add_film(film_, part); !added) return added.error();
    state_.samples += part.samples;
    state_.seconds += part.seconds;
    state_.rays = {state_.rays.camera + part.rays.camera, state_.rays.bounce + part.rays.bounce, state_.rays.shadow + part.rays.shadow};
    state_.truncated += part.truncated;
    if (!state_.reuse_pilot) state_.reuse_pilot = part.reuse_pilot;
    if (!state_.highlights) state_.highlights = part.highlights;
    add_counts(state_.path_counts, part.path_counts);
    if (state_.shares[0].empty()) state_.shares = part.shares;
    measure_pilot();
    return {};
}

// As a renderer does that renders all parts.
void FilmMerger::measure_pilot() {
    if (!settings_.adaptive || state_.first_sample > 0 || !state_.shares[0].empty()) return;
    if (state_.samples == SampleAllocation::pilot_samples / 2) pilot_.mark(film_);
    if (state_.samples != SampleAllocation::pilot_samples || pilot_.marked().empty()) return;
    SampleAllocation allocation;
    allocation.reset(film_.width(), film_.height());
    allocation.decide(pilot_.measure(film_));
    state_.shares = allocation.shares();
}

FilmState FilmMerger::sum() const {
    FilmState sum = save_film(film_);
    FilmState head = state_;
    head.planes = std::move(sum.planes);
    head.passes = sum.passes;
    head.health = std::move(sum.health);
    if (state_.samples < SampleAllocation::pilot_samples) head.marked = pilot_.marked();
    return head;
}

Result<FilmState> merge_films(const FilmState& a, const FilmState& b, const RenderSettings& settings) {
    FilmMerger merger(settings);
    const bool in_order = a.first_sample <= b.first_sample;
    for (const FilmState* part : {in_order ? &a : &b, in_order ? &b : &a})
        if (const Result<void> added = merger.add(*part); !added) return added.error();
    return merger.sum();
}

} // namespace blush
