// Arrays of geometry: vectors whose elements may lie in memory of the owner's choice, so that large ones are read without a copy.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace blush {

// Uses its place if exactly the expected number of elements is requested, else the heap. Copied arrays go to the heap, moved ones
// stay in place. Elements that come without a value, as by resize(n), stay unset: many threads fill large arrays, and the one that
// resizes them would touch all their memory first.
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
    template <class U> void construct(U* element) { ::new (static_cast<void*>(element)) U; }
    bool operator==(const PlacedAllocator& other) const { return place_ == other.place_; }

private:
    T* place_ = nullptr;
    size_t count_ = 0;
};
template <class T> using GeometryArray = std::vector<T, PlacedAllocator<T>>;

} // namespace blush
