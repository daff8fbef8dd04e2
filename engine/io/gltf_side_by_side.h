// Internal to gltf_*.cpp: the pieces of a file that any thread may read, read by many, with what comes of them in the file's order.
#pragma once

#include "io/gltf_source.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace blush {

struct GltfPieces {
    std::vector<int64_t> sizes; // bytes that each needs
    int64_t large = 0;          // those that need more are read one after another
    const char* what = "";      // for the progress, which goes
    double from = 0, to = 1;    // from here to there, on the calling thread
    unsigned threads = 0;       // as ImportOptions has them
};

// Calls read(own, i) once for each piece, where `own` is a context with a report of the piece's own, and adds the reports to that of
// `context` in order. Those behind one that cannot be read may be left out. Errors: the first in the file, cancelled.
Result<void> read_side_by_side(const GltfContext& context, const GltfPieces& pieces,
                               const std::function<Result<void>(const GltfContext& own, size_t i)>& read);

} // namespace blush
