// Loops over many small elements, such as the vertices of a large mesh, on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace blush {

// Calls work(begin, end) for ranges that cover [0, count) once, on up to `threads` threads, this one included; 0: one per core.
// A loop too short to gain is one call, on this thread. Rethrows an exception of `work`.
void for_ranges(size_t count, unsigned threads, const std::function<void(size_t begin, size_t end)>& work);

// The sum of what part(begin, end) returns for these ranges.
size_t sum_of_ranges(size_t count, unsigned threads, const std::function<size_t(size_t begin, size_t end)>& part);

// Number of elements in [0, count) of which is(i) holds.
template <class Is> size_t count_in_ranges(size_t count, unsigned threads, const Is& is) {
    return sum_of_ranges(count, threads, [&](size_t begin, size_t end) {
        size_t n = 0;
        for (size_t i = begin; i < end; ++i) n += is(i) ? 1 : 0;
        return n;
    });
}

} // namespace blush
