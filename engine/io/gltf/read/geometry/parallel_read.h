// Internal to io/gltf: reads independent pieces of a file in parallel, with diagnostics in file order.
#pragma once

#include "io/gltf/read/context.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace blush {

struct GltfPieces {
    std::vector<int64_t> sizes; // memory of each piece, bytes
    int64_t large = 0;          // larger pieces are read one at a time
    const char* what = "";      // label of the progress
    double from = 0, to = 1;    // progress range, reported on the calling thread
    unsigned threads = 0;       // as in ImportOptions
};

// Calls read(own, i) for each piece, where `own` is a context with its own report, and appends the reports to that of `context`
// in order. After an error later pieces may be skipped. Errors: the first in file order, cancelled.
Result<void> read_in_parallel(const GltfContext& context, const GltfPieces& pieces,
                              const std::function<Result<void>(const GltfContext& own, size_t i)>& read);

} // namespace blush
