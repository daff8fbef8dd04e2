#include "render/diagnostics/health_recorder.h"

#include <algorithm>
#include <tuple>

namespace blush {
namespace {

// Appends, and keeps the first hundred in a strict order, so that the result does not depend on arrival order.
template <class T, class Less> void merge_first(std::vector<T>& kept, const std::vector<T>& more, const Less& less) {
    kept.insert(kept.end(), more.begin(), more.end());
    std::sort(kept.begin(), kept.end(), less);
    if (kept.size() > HealthRecorder::remembered) kept.resize(HealthRecorder::remembered);
}

template <class T> auto place_in_order(const T& s) { return std::tuple(s.sample, s.y, s.x); }

// Several light paths of one pass may reach one pixel: their causes make the order strict.
bool comes_before(const BadSample& a, const BadSample& b) {
    return std::tuple(place_in_order(a), a.fault.place, a.cause) < std::tuple(place_in_order(b), b.fault.place, b.cause);
}
bool is_worse(const Firefly& a, const Firefly& b) {
    return a.excess != b.excess ? a.excess > b.excess : place_in_order(a) < place_in_order(b);
}

int64_t& counter(Health& health, BadSample::Cause cause) {
    switch (cause) {
    case BadSample::Cause::nan: return health.nan;
    case BadSample::Cause::infinite: return health.infinite;
    case BadSample::Cause::negative: break;
    }
    return health.negative;
}

} // namespace

void HealthRecorder::reset() {
    health_ = {};
    min_excess_ = min_firefly_excess;
}

void HealthRecorder::restore(const Health& health) {
    health_ = health;
    min_excess_ = health.fireflies.size() == remembered ? health.fireflies.back().excess : min_firefly_excess;
}

void HealthRecorder::add_dropped(const std::vector<BadSample>& samples, size_t width, size_t pixels) {
    const std::lock_guard lock(mutex_);
    health_.dropped_map.resize(pixels);
    for (const BadSample& s : samples) {
        ++counter(health_, s.cause);
        ++health_.faults[size_t(s.fault.kind)][size_t(s.fault.place)];
        ++health_.dropped_map[size_t(s.y) * width + size_t(s.x)];
    }
    merge_first(health_.first, samples, comes_before);
}

void HealthRecorder::add_fireflies(const std::vector<Firefly>& samples) {
    const std::lock_guard lock(mutex_);
    merge_first(health_.fireflies, samples, is_worse);
    if (health_.fireflies.size() == remembered) min_excess_ = health_.fireflies.back().excess;
}

Health HealthRecorder::merged(const Health& a, const Health& b) {
    Health sum = a;
    sum.nan += b.nan;
    sum.infinite += b.infinite;
    sum.negative += b.negative;
    sum.truncated += b.truncated;
    for (size_t kind = 0; kind < sum.faults.size(); ++kind)
        for (size_t place = 0; place < sum.faults[kind].size(); ++place) sum.faults[kind][place] += b.faults[kind][place];
    merge_first(sum.first, b.first, comes_before);
    merge_first(sum.fireflies, b.fireflies, is_worse);
    sum.dropped_map.resize(std::max(a.dropped_map.size(), b.dropped_map.size()));
    for (size_t i = 0; i < b.dropped_map.size(); ++i) sum.dropped_map[i] += b.dropped_map[i];
    return sum;
}

} // namespace blush
