#include "scene/geometry/arena_geometry.h"

#include "core/geometry_arena.h"

namespace blush {
namespace {

// Geometry::storage of meshes in the arena.
struct ArenaStorage {
    ArenaRangePtr vertices, indices;
};

// Calls visit(array, attribute) for each attribute that the mesh has; stops and returns false at the first false.
template <class G, class Visit> bool all_attributes(G& g, const Visit& visit) {
    const auto absent_or = [&](auto& array, Attribute attribute) { return array.empty() || visit(array, attribute); };
    bool good = absent_or(g.positions, Attribute::positions) && absent_or(g.normals, Attribute::normals) &&
                absent_or(g.tangents, Attribute::tangents) && absent_or(g.colors, Attribute::colors);
    for (size_t set = 0; good && set < g.uv.size(); ++set) good = absent_or(g.uv[set], uv_attribute_of(int(set)));
    return good;
}

template <class T> void move_to(GeometryArray<T>& array, T* base, int64_t first) {
    GeometryArray<T> placed(PlacedAllocator<T>(base + first, array.size()));
    placed.reserve(array.size());
    placed.assign(array.begin(), array.end());
    array = std::move(placed);
}

template <class T> T* base_of(const GeometryArray<T>&, Attribute attribute) { return attribute_base<T>(attribute); }

} // namespace

void move_to_arena(Geometry& g) {
    if (g.positions.size() < min_arena_vertices) return;
    if (!all_attributes(g, [](const auto& array, Attribute attribute) { return base_of(array, attribute) != nullptr; })) return;
    ArenaRangePtr vertices = reserve_arena_range(ArenaKind::vertices, g.positions.size()),
                  indices = reserve_arena_range(ArenaKind::indices, g.indices.size());
    if (!vertices || !indices) return;
    all_attributes(g, [&](auto& array, Attribute attribute) {
        move_to(array, base_of(array, attribute), vertices->first());
        return true;
    });
    move_to(g.indices, index_base(), indices->first());
    g.storage = std::make_shared<const ArenaStorage>(ArenaStorage{std::move(vertices), std::move(indices)});
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
