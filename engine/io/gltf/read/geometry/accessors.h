// Internal to io/gltf: reads accessors into typed arrays. Every offset, count and stride is checked in 64 bits before use.
#pragma once

#include "io/gltf/read/context.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace blush {

// The bytes of a buffer view. Errors: index out of range, range beyond its buffer.
Result<std::span<const uint8_t>> buffer_view_bytes(const GltfContext& context, int buffer_view, const std::string& where);

struct FloatArray {
    int components = 0;        // 1 .. 4, or 16
    std::vector<float> values; // count * components
    size_t count() const { return components ? values.size() / size_t(components) : 0; }
};

// Reads any component type; integers keep their value, or map to [0, 1] / [-1, 1] if the accessor is normalised (glTF 2.0,
// 3.6.2.2).
// Errors: out of range, beyond its view or buffer, fewer than `min_components` or more than `max_components` per element.
Result<FloatArray> read_floats(const GltfContext& context, int accessor, int min_components, int max_components, const std::string& where);

// Unsigned integers of 8, 16 or 32 bits.
Result<std::vector<uint32_t>> read_indices(const GltfContext& context, int accessor, const std::string& where);

} // namespace blush
