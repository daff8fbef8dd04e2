#include "ui/views/lab/survivors_view.h"

#include "core/math.h"

#include <algorithm>

namespace blush {
namespace {

constexpr double seconds_of_step = 1.2;

Survivor survivor(const RecordedPath& path, int64_t bounce) {
    Survivor s;
    for (size_t i = 0; i < path.vertices.size() && int64_t(i) < bounce; ++i) {
        const PathVertex& v = path.vertices[i];
        if (v.end == PathEnd::roulette) return {Survivor::Fate::killed, 0};
        if (v.roulette) s.weight /= double(v.survival);
        if (v.end != PathEnd::none) s.fate = Survivor::Fate::ended;
    }
    return s;
}

} // namespace

void SurvivorsView::stop() {
    with_roulette.reset();
    without.reset();
    of_roulette = of_none = {};
    playing = false;
}

Survivors survivors_behind(const PathSet& set, int64_t bounce) {
    Survivors all;
    for (const auto& path : set.paths) {
        const Survivor s = survivor(*path, bounce);
        all.paths.push_back(s);
        ++all.counts[size_t(s.fate)];
        all.weight += s.weight;
        if (s.fate == Survivor::Fate::lives) all.living_weight += s.weight;
    }
    const int64_t living = all.counts[size_t(Survivor::Fate::lives)];
    if (living > 0) all.living_weight /= double(living);
    return all;
}

int64_t most_bounces(const PathSet& set) {
    size_t most = 0;
    for (const auto& path : set.paths) most = std::max(most, path->vertices.size());
    return int64_t(most);
}

std::optional<PathCost> cost_of(const PathSet& set) {
    double sum = 0, squares = 0, vertices = 0;
    int64_t valid = 0;
    for (const auto& path : set.paths) {
        vertices += double(path->vertices.size());
        if (!path->is_valid()) continue;
        const double y = double(luminance(path->radiance));
        sum += y;
        squares += y * y;
        ++valid;
    }
    if (valid < 2 || set.means.empty()) return {};
    PathCost cost;
    cost.mean = sum / double(valid);
    cost.half = set.means.back().half();
    cost.variance = std::max(0.0, (squares - sum * cost.mean) / double(valid - 1));
    cost.vertices = vertices / double(set.paths.size());
    return cost;
}

double play(SurvivorsView& view, int64_t last_bounce, double now) {
    if (now < view.step_due) return view.step_due - now;
    view.step_due = now + seconds_of_step;
    view.bounce = view.bounce < last_bounce ? view.bounce + 1 : 0;
    return seconds_of_step;
}

} // namespace blush
