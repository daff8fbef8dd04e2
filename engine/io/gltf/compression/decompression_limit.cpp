#include "io/gltf/compression/decompression_limit.h"

#include <fmt/format.h>

namespace blush {

Result<void> DecompressionLimit::take(const GltfContext& context, double bytes, const char* where) {
    constexpr double free_bytes = 512e6, max_decompression_ratio = 128; // scans reach a ratio of 40, flat grids far more
    taken_ += bytes;
    if (taken_ <= free_bytes + max_decompression_ratio * packed_) return {};
    return context.error(
        fmt::format("its compressed data would decompress to {:.0f} MB, but its buffers have only {:.3g} MB", taken_ / 1e6, packed_ / 1e6),
        where);
}

} // namespace blush
