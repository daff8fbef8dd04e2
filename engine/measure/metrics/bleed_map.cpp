#include "measure/metrics/bleed_map.h"

#include "core/math.h"

#include <algorithm>

namespace blush {
namespace {

// So that a round takes about a tenth of a second.
constexpr size_t cells_per_round = 256;

} // namespace

void BleedMap::begin(const Scene& scene, const RenderSettings& settings, int cell) {
    tracer_.begin(scene, settings);
    grid_ = {cell, (settings.width + cell - 1) / cell, (settings.height + cell - 1) / cell, 0, {}};
    grid_.cells.resize(size_t(grid_.columns) * size_t(grid_.rows));
    sums_.assign(grid_.cells.size(), {});
    targets_.clear();
    next_ = 0;
    for (int y = 0; y < settings.height; y += cell)
        for (int x = 0; x < settings.width; x += cell) {
            BleedTarget target;
            target.pixels = {x, y, std::min(x + cell, settings.width), std::min(y + cell, settings.height)};
            targets_.push_back(target);
        }
}

bool BleedMap::round(const std::function<bool()>& wanted) {
    const size_t count = std::min(cells_per_round, targets_.size() - next_);
    const auto found = tracer_.trace_each(std::span(targets_).subspan(next_, count), grid_.passes, wanted);
    if (found.size() != count) return false;
    for (size_t i = 0; i < count; ++i) {
        Sums& sums = sums_[next_ + i];
        for (const auto& [sender, flow] : found[i].senders) {
            sums.whole += flow.weight;
            if (sender.by == SentBy::object) sums.by_object[uint32_t(sender.id)] += flow.weight;
        }
        const auto greatest = std::ranges::max_element(sums.by_object, {}, [](const auto& entry) { return entry.second; });
        if (greatest != sums.by_object.end() && greatest->second > 0)
            grid_.cells[next_ + i] = {greatest->first, float(greatest->second / sums.whole)};
    }
    next_ += count;
    if (next_ < targets_.size()) return true;
    next_ = 0;
    ++grid_.passes;
    return true;
}

} // namespace blush
