// Internal to io/gltf: reads accessors into typed arrays. Every offset, count and stride is checked in 64 bits before use.
#pragma once

#include "io/gltf/read/context.h"

#include <cstdint>
#include <functional>
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
// 3.6.2.2). Long accessors are read by all threads.
// Errors: out of range, beyond its view or buffer, fewer than `min_components` or more than `max_components` per element.
Result<FloatArray> read_floats(const GltfContext& context, int accessor, int min_components, int max_components, const std::string& where);

// The same into room that the caller makes once the accessor is known to be whole: element i begins at values + i * stride.
struct FloatRoom {
    float* values = nullptr;
    size_t stride = 0; // at least `components`
};
using MakeFloatRoom = std::function<FloatRoom(size_t count, int components)>;
Result<void> read_floats(const GltfContext& context, int accessor, int min_components, int max_components, const std::string& where,
                         const MakeFloatRoom& make_room);

// Unsigned integers of 8, 16 or 32 bits, into room for `count`.
using MakeIndexRoom = std::function<uint32_t*(size_t count)>;
Result<void> read_indices(const GltfContext& context, int accessor, const std::string& where, const MakeIndexRoom& make_room);

// What the accessor says its number of elements is, before anything is checked; 0 if it does not exist.
uint64_t accessor_count(const GltfContext& context, int accessor);

} // namespace blush
