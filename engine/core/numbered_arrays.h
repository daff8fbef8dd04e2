// Arrays that lie where numbers find them: for each attribute of vertices, and for the indices of triangles, one stretch of addresses that is
// reserved once for the whole process. Kernels read all shapes by one base address an attribute and one 32-bit number for all of them; large arrays
// of the document lie there from the start, so that they are rendered where they are, without a copy. Memory is taken only for what is written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace blush {

enum class Numbering { vertices, indices };

// So many numbers that nobody else has; given back, with the memory that was taken for them, when this ends. Thread-safe.
class NumberRange {
public:
    NumberRange(Numbering numbering, int64_t first, int64_t count) : numbering_(numbering), first_(first), count_(count) {}
    ~NumberRange();
    NumberRange(const NumberRange&) = delete;
    NumberRange& operator=(const NumberRange&) = delete;

    int64_t first() const { return first_; }

private:
    Numbering numbering_;
    int64_t first_, count_;
};
using NumbersPtr = std::shared_ptr<const NumberRange>;

// Null if no stretch of so many is left, or if addresses cannot be reserved at all (ulimit -v): arrays then lie on the heap and are copied.
NumbersPtr take_numbers(Numbering numbering, size_t count);
// Numbers in all: vertices times four and indices stay below 2^31, as kernels need it.
constexpr int64_t most_numbers(Numbering numbering) { return numbering == Numbering::vertices ? int64_t(1) << 29 : (int64_t(1) << 31) - 4096; }

// Attributes of vertices; texture coordinates of set n are first_uv + n.
enum class Attribute : int { positions, normals, tangents, colors, first_uv };
constexpr Attribute uv_attribute_of(int set) { return Attribute(int(Attribute::first_uv) + set); }

namespace detail {
void* attribute_base(Attribute attribute, size_t element_bytes);
void* index_base();
} // namespace detail

// Where number 0 of an attribute would be; what no array was written to reads as zeros, and 16 bytes behind the last one may be read too. Null if its
// addresses cannot be reserved.
template <class T> T* attribute_base(Attribute attribute) { return static_cast<T*>(detail::attribute_base(attribute, sizeof(T))); }
inline uint32_t* index_base() { return static_cast<uint32_t*>(detail::index_base()); }

// A vector's memory: at a place of its own if it asks for exactly as many elements as that was made for, else from the heap. Copies of vectors go to
// the heap, moved ones stay.
template <class T> class PlacedAllocator {
public:
    using value_type = T;
    using propagate_on_container_move_assignment = std::true_type;
    using propagate_on_container_swap = std::true_type;
    using is_always_equal = std::false_type;

    PlacedAllocator() = default;
    PlacedAllocator(T* place, size_t count) : place_(place), count_(count) {}
    template <class U> PlacedAllocator(const PlacedAllocator<U>&) {}
    PlacedAllocator select_on_container_copy_construction() const { return {}; }

    T* allocate(size_t n) { return place_ && n == count_ ? place_ : std::allocator<T>().allocate(n); }
    void deallocate(T* p, size_t n) {
        if (p != place_) std::allocator<T>().deallocate(p, n);
    }
    bool operator==(const PlacedAllocator& other) const { return place_ == other.place_; }

private:
    T* place_ = nullptr;
    size_t count_ = 0;
};
template <class T> using PlacedVector = std::vector<T, PlacedAllocator<T>>;

} // namespace blush
