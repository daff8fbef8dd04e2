#include "core/geometry_arena.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <sys/mman.h>

namespace blush {
namespace {

// Alignment of ranges, in elements: they begin at a page boundary in every attribute, whose elements are multiples of four bytes.
constexpr int64_t granule = 1024;
constexpr size_t page = 4096;

class Stretch {
public:
    explicit Stretch(size_t element_bytes, int64_t count) : element_bytes_(element_bytes) {
        void* at =
            mmap(nullptr, element_bytes * size_t(count) + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        base_ = at == MAP_FAILED ? nullptr : static_cast<std::byte*>(at);
    }
    void* base() const { return base_; }
    void forget(int64_t first, int64_t count) const {
        if (base_) madvise(base_ + size_t(first) * element_bytes_, size_t(count) * element_bytes_, MADV_DONTNEED);
    }

private:
    size_t element_bytes_;
    std::byte* base_ = nullptr;
};

// Free ranges by first offset.
class FreeRanges {
public:
    explicit FreeRanges(int64_t count) : free_{{0, count}} {}

    std::optional<int64_t> take(int64_t count) {
        const auto found = std::ranges::find_if(free_, [&](const auto& range) { return range.second >= count; });
        if (found == free_.end()) return {};
        const auto [first, room] = *found;
        free_.erase(found);
        if (room > count) free_.emplace(first + count, room - count);
        return first;
    }
    void give_back(int64_t first, int64_t count) {
        auto next = free_.lower_bound(first);
        if (next != free_.end() && first + count == next->first) {
            count += next->second;
            next = free_.erase(next);
        }
        if (next != free_.begin())
            if (const auto before = std::prev(next); before->first + before->second == first) {
                before->second += count;
                return;
            }
        free_.emplace(first, count);
    }

private:
    std::map<int64_t, int64_t> free_;
};

// Never destroyed: payloads with static lifetime return their ranges at exit.
struct Addresses {
    std::mutex mutex;
    FreeRanges vertices{arena_capacity(ArenaKind::vertices)}, indices{arena_capacity(ArenaKind::indices)};
    std::map<Attribute, Stretch> attributes;
    std::optional<Stretch> index_stretch;

    FreeRanges& free(ArenaKind kind) { return kind == ArenaKind::vertices ? vertices : indices; }
    void* attribute(Attribute which, size_t element_bytes) {
        return attributes.try_emplace(which, element_bytes, arena_capacity(ArenaKind::vertices)).first->second.base();
    }
    void* index() {
        if (!index_stretch) index_stretch.emplace(sizeof(uint32_t), arena_capacity(ArenaKind::indices));
        return index_stretch->base();
    }
};
Addresses& addresses() {
    static Addresses& a = *new Addresses;
    return a;
}

} // namespace

ArenaRangePtr reserve_arena_range(ArenaKind kind, size_t count) {
    if (count > size_t(arena_capacity(kind))) return {};
    Addresses& a = addresses();
    const int64_t rounded = std::max<int64_t>(1, (int64_t(count) + granule - 1) / granule) * granule;
    std::optional<int64_t> first;
    {
        const std::lock_guard lock(a.mutex);
        const bool reserved = kind == ArenaKind::indices ? a.index() : a.attribute(Attribute::positions, 3 * sizeof(float));
        if (reserved) first = a.free(kind).take(rounded);
    }
    return first ? std::make_shared<const ArenaRange>(kind, *first, rounded) : nullptr;
}

ArenaRange::~ArenaRange() {
    Addresses& a = addresses();
    const std::lock_guard lock(a.mutex);
    if (kind_ == ArenaKind::indices)
        a.index_stretch->forget(first_, count_);
    else
        for (const auto& [attribute, stretch] : a.attributes) stretch.forget(first_, count_);
    a.free(kind_).give_back(first_, count_);
}

void* detail::attribute_base(Attribute attribute, size_t element_bytes) {
    Addresses& a = addresses();
    const std::lock_guard lock(a.mutex);
    return a.attribute(attribute, element_bytes);
}

void* detail::index_base() {
    Addresses& a = addresses();
    const std::lock_guard lock(a.mutex);
    return a.index();
}

} // namespace blush
