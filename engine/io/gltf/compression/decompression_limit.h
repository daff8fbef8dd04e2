// Internal to the import: limits the memory of decompressed data.
#pragma once

#include "io/gltf/read/context.h"

namespace blush {

// Memory limit of decompression. Compressed bytes may be referenced many times, so that a small file could need any amount of
// memory.
class DecompressionLimit {
public:
    // `source` must not be decompressed yet.
    explicit DecompressionLimit(const GltfSource& source) : packed_(source.bytes_in_buffers()) {}
    // Reserves bytes. Errors: the limit is exceeded.
    Result<void> take(const GltfContext& context, double bytes, const char* where);

private:
    double packed_ = 0, taken_ = 0;
};

} // namespace blush
