#include "core/for_ranges.h"

#include "core/task_queue.h"

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace blush {

void for_ranges(size_t count, unsigned threads, const std::function<void(size_t, size_t)>& work) {
    constexpr size_t range = size_t(1) << 16;
    const size_t ranges = (count + range - 1) / range;
    if (count == 0) return;
    if (threads == 1 || ranges < 4) return work(0, count);
    TaskQueue helpers(threads);
    helpers.begin(std::vector<int64_t>(ranges), 0, [&](size_t i) { work(i * range, std::min(count, (i + 1) * range)); });
    helpers.finish();
}

size_t sum_of_ranges(size_t count, unsigned threads, const std::function<size_t(size_t, size_t)>& part) {
    std::atomic<size_t> sum = 0;
    for_ranges(count, threads, [&](size_t begin, size_t end) { sum += part(begin, end); });
    return sum;
}

} // namespace blush
