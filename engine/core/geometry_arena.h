// Geometry arena: reserves one virtual address range per vertex attribute and one for triangle indices, for the whole process.
// Kernels address all meshes by one base pointer per attribute and a 32-bit element offset. Large arrays of the document are
// placed in the arena (geometry_array.h), so that they are rendered without a copy. Physical memory is used only for pages that are
// written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace blush {

enum class ArenaKind { vertices, indices };

// A range of element offsets that is owned exclusively. The destructor returns the offsets and their memory. Thread-safe.
class ArenaRange {
public:
    ArenaRange(ArenaKind kind, int64_t first, int64_t count) : kind_(kind), first_(first), count_(count) {}
    ~ArenaRange();
    ArenaRange(const ArenaRange&) = delete;
    ArenaRange& operator=(const ArenaRange&) = delete;

    int64_t first() const { return first_; }

private:
    ArenaKind kind_;
    int64_t first_, count_;
};
using ArenaRangePtr = std::shared_ptr<const ArenaRange>;

// Reserves `count` offsets. Null if no free range is large enough or if addresses cannot be reserved (ulimit -v): arrays are then
// on the heap and are copied.
ArenaRangePtr reserve_arena_range(ArenaKind kind, size_t count);
// Size of the arena in elements: vertices * 4 and indices stay below 2^31, as kernels require.
constexpr int64_t arena_capacity(ArenaKind kind) { return kind == ArenaKind::vertices ? int64_t(1) << 29 : (int64_t(1) << 31) - 4096; }

// Vertex attributes; UV set n is first_uv + n.
enum class Attribute : int { positions, normals, tangents, colors, first_uv };
constexpr Attribute uv_attribute_of(int set) { return Attribute(int(Attribute::first_uv) + set); }

namespace detail {
void* attribute_base(Attribute attribute, size_t element_bytes);
void* index_base();
} // namespace detail

// Base address of an attribute (offset 0). Unwritten elements read as zeros; 16 bytes of padding behind the last one are
// readable. Null if the addresses cannot be reserved.
template <class T> T* attribute_base(Attribute attribute) { return static_cast<T*>(detail::attribute_base(attribute, sizeof(T))); }
inline uint32_t* index_base() { return static_cast<uint32_t*>(detail::index_base()); }

} // namespace blush
