#include "scene/geometry/arena_geometry.h"

namespace blush {
namespace {

// Calls visit(array, attribute) for each attribute that the mesh has; stops and returns false at the first false.
template <class G, class Visit> bool all_attributes(G& g, const Visit& visit) {
    const auto absent_or = [&](auto& array, Attribute attribute) { return array.empty() || visit(array, attribute); };
    bool good = absent_or(g.positions, Attribute::positions) && absent_or(g.normals, Attribute::normals) &&
                absent_or(g.tangents, Attribute::tangents) && absent_or(g.colors, Attribute::colors);
    for (size_t set = 0; good && set < g.uv.size(); ++set) good = absent_or(g.uv[set], uv_attribute_of(int(set)));
    return good;
}

template <class T> void move_to(ArenaVector<T>& array, T* base, int64_t first) {
    ArenaVector<T> placed(ArenaAllocator<T>(base + first, array.size()));
    placed.reserve(array.size());
    placed.assign(array.begin(), array.end());
    array = std::move(placed);
}

template <class T> T* base_of(const ArenaVector<T>&, Attribute attribute) { return attribute_base<T>(attribute); }

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
    g.vertex_range = std::move(vertices);
    g.index_range = std::move(indices);
}

std::optional<ArenaOffsets> arena_offsets(const Geometry& g) {
    if (!g.vertex_range || !g.index_range) return {};
    const ArenaOffsets at{int32_t(g.vertex_range->first()), int32_t(g.index_range->first())};
    const bool placed = g.indices.data() == index_base() + at.first_index && all_attributes(g, [&](const auto& array, Attribute attribute) {
                            return array.data() == base_of(array, attribute) + at.first_vertex;
                        });
    return placed ? std::optional(at) : std::nullopt;
}

} // namespace blush
