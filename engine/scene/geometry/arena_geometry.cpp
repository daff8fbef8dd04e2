#include "scene/geometry/arena_geometry.h"

namespace blush {
namespace {

// Geometry::storage of meshes in the arena.
struct ArenaStorage {
    ArenaRangePtr vertices, indices;
    size_t vertex_count = 0, index_count = 0; // that it has room for
};

// Calls visit(array, attribute) for each attribute that the mesh has; stops and returns false at the first false.
template <class G, class Visit> bool all_attributes(G& g, const Visit& visit) {
    const auto absent_or = [&](auto& array, Attribute attribute) { return array.empty() || visit(array, attribute); };
    bool good = absent_or(g.positions, Attribute::positions) && absent_or(g.normals, Attribute::normals) &&
                absent_or(g.tangents, Attribute::tangents) && absent_or(g.colors, Attribute::colors);
    for (size_t set = 0; good && set < g.uv.size(); ++set) good = absent_or(g.uv[set], uv_attribute_of(int(set)));
    return good;
}

template <class T> GeometryArray<T> placed(const GeometryArray<T>& array, T* base, int64_t first) {
    GeometryArray<T> copy(PlacedAllocator<T>(base + first, array.size()));
    copy.reserve(array.size());
    copy.assign(array.begin(), array.end());
    return copy;
}

template <class T> T* base_of(const GeometryArray<T>&, Attribute attribute) { return attribute_base<T>(attribute); }

// Ranges for the arrays of a large mesh; none for a small one, or if the arena is full.
std::optional<ArenaStorage> reserve_ranges(size_t vertices, size_t indices) {
    if (vertices < min_arena_vertices) return {};
    ArenaStorage storage{reserve_arena_range(ArenaKind::vertices, vertices), reserve_arena_range(ArenaKind::indices, indices), vertices,
                         indices};
    return storage.vertices && storage.indices ? std::optional(std::move(storage)) : std::nullopt;
}
std::optional<ArenaStorage> reserve_for(const Geometry& g) {
    if (!all_attributes(g, [](const auto& array, Attribute attribute) { return base_of(array, attribute) != nullptr; })) return {};
    return reserve_ranges(g.positions.size(), g.indices.size());
}

// `base`: of the arena, null if the array is to be on the heap.
template <class T> GeometryArray<T> unset_at(T* base, const ArenaRangePtr& range, size_t count) {
    GeometryArray<T> array(base ? PlacedAllocator<T>(base + range->first(), count) : PlacedAllocator<T>());
    array.reserve(base ? count : count + 1);
    array.resize(count);
    return array;
}

} // namespace

std::shared_ptr<const void> reserve_in_arena(size_t vertices, size_t indices) {
    std::optional<ArenaStorage> storage = reserve_ranges(vertices, indices);
    return storage ? std::make_shared<const ArenaStorage>(*std::move(storage)) : nullptr;
}

template <class T> GeometryArray<T> unset_array(const std::shared_ptr<const void>& storage, Attribute attribute, size_t count) {
    const auto* ranges = static_cast<const ArenaStorage*>(storage.get());
    const bool fits = ranges && ranges->vertex_count == count;
    return fits ? unset_at(attribute_base<T>(attribute), ranges->vertices, count) : unset_at<T>(nullptr, {}, count);
}
template GeometryArray<Vec2> unset_array(const std::shared_ptr<const void>&, Attribute, size_t);
template GeometryArray<Vec3> unset_array(const std::shared_ptr<const void>&, Attribute, size_t);
template GeometryArray<Vec4> unset_array(const std::shared_ptr<const void>&, Attribute, size_t);

GeometryArray<uint32_t> unset_indices(const std::shared_ptr<const void>& storage, size_t count) {
    const auto* ranges = static_cast<const ArenaStorage*>(storage.get());
    const bool fits = ranges && ranges->index_count == count;
    return fits ? unset_at(index_base(), ranges->indices, count) : unset_at<uint32_t>(nullptr, {}, count);
}

void move_to_arena(Geometry& g) {
    if (arena_offsets(g)) return;
    std::optional<ArenaStorage> storage = reserve_for(g);
    if (!storage) return;
    all_attributes(g, [&](auto& array, Attribute attribute) {
        array = placed(array, base_of(array, attribute), storage->vertices->first());
        return true;
    });
    g.indices = placed(g.indices, index_base(), storage->indices->first());
    g.storage = std::make_shared<const ArenaStorage>(*std::move(storage));
}

void copy_arrays(const Geometry& from, Geometry& to) {
    std::optional<ArenaStorage> storage = reserve_for(from);
    const auto copy = [&](const auto& array, Attribute attribute) {
        return storage && !array.empty() ? placed(array, base_of(array, attribute), storage->vertices->first()) : array;
    };
    to.positions = copy(from.positions, Attribute::positions);
    to.normals = copy(from.normals, Attribute::normals);
    to.tangents = copy(from.tangents, Attribute::tangents);
    to.colors = copy(from.colors, Attribute::colors);
    to.uv.resize(from.uv.size());
    for (size_t set = 0; set < from.uv.size(); ++set) to.uv[set] = copy(from.uv[set], uv_attribute_of(int(set)));
    to.indices = storage ? placed(from.indices, index_base(), storage->indices->first()) : from.indices;
    if (storage) to.storage = std::make_shared<const ArenaStorage>(*std::move(storage));
}

std::optional<ArenaOffsets> arena_offsets(const Geometry& g) {
    if (!g.storage) return {};
    const auto& ranges = *static_cast<const ArenaStorage*>(g.storage.get());
    const ArenaOffsets at{int32_t(ranges.vertices->first()), int32_t(ranges.indices->first())};
    const bool placed = g.indices.data() == index_base() + at.first_index && all_attributes(g, [&](const auto& array, Attribute attribute) {
                            return array.data() == base_of(array, attribute) + at.first_vertex;
                        });
    return placed ? std::optional(at) : std::nullopt;
}

} // namespace blush
