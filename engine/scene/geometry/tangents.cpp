#include "scene/geometry/tangents.h"

#include "scene/geometry/mikktspace.h"

#include <algorithm>

namespace blush {
namespace {

template <class Values> void append_copies(Values& values, const std::vector<uint32_t>& of, size_t per_vertex = 1) {
    if (values.empty()) return;
    values.reserve(values.size() + of.size() * per_vertex);
    for (const uint32_t i : of)
        for (size_t k = 0; k < per_vertex; ++k) values.push_back(values[i * per_vertex + k]);
}

template <class Values> void drop_copies(Values& values, size_t copies, size_t per_vertex = 1) {
    if (!values.empty()) values.resize(values.size() - copies * per_vertex);
}

int uv_set_of(const Material* m) {
    if (!m) return -1;
    if (m->normal_texture.texture) return m->normal_texture.uv_set;
    if (m->clearcoat_normal_texture.texture) return m->clearcoat_normal_texture.uv_set;
    return m->anisotropy > 0 ? m->anisotropy_texture.uv_set : -1;
}

} // namespace

int tangent_uv_set(const Scene& scene, const MeshPart& part) {
    if (part.by_variant.empty()) return uv_set_of(scene.materials.find(part.material));
    for (const Id<Material> material : part.by_variant)
        if (const int set = uv_set_of(scene.materials.find(material)); set >= 0) return set;
    return -1;
}

bool any_needs_tangents(const Scene& scene) {
    return std::ranges::any_of(scene.materials, [](const auto& entry) { return uv_set_of(&entry.value) >= 0; });
}

void add_tangents(Geometry& g, int uv_set) {
    const std::vector<Vec4> corners = mikktspace_tangents(g, g.uv[size_t(uv_set)]);
    const auto count = uint32_t(g.positions.size());
    constexpr uint32_t end_of_list = UINT32_MAX;
    g.tangents.assign(count, Vec4{0, 0, 0, 0});     // zero: not assigned yet
    std::vector<uint32_t> next(count, end_of_list); // linked list of copies of a vertex that differ in their tangent
    std::vector<uint32_t> copied;
    for (size_t i = 0; i < corners.size(); ++i) {
        const bool is_free = g.tangents[g.indices[i]] == Vec4{0, 0, 0, 0};
        uint32_t vertex = g.indices[i];
        if (is_free) g.tangents[vertex] = corners[i];
        while (g.tangents[vertex] != corners[i] && next[vertex] != end_of_list) vertex = next[vertex];
        if (g.tangents[vertex] != corners[i]) {
            next[vertex] = count + uint32_t(copied.size());
            vertex = next[vertex];
            next.push_back(end_of_list);
            copied.push_back(g.indices[i]);
            g.tangents.push_back(corners[i]);
        }
        g.indices[i] = vertex;
    }
    for (Vec4& t : g.tangents)
        if (t == Vec4{0, 0, 0, 0}) t = {1, 0, 0, 1}; // unused vertices
    g.generated_tangents = GeneratedTangents{uv_set, copied};
    if (copied.empty()) return;
    for (MorphTargetPtr& target : g.targets) {
        auto longer = std::make_shared<MorphTarget>(*target);
        for (const auto offsets : {&MorphTarget::positions, &MorphTarget::normals, &MorphTarget::tangents})
            append_copies((*longer).*offsets, copied);
        target = std::move(longer);
    }
    append_copies(g.influences, copied, g.influences.size() / count);
    append_copies(g.positions, copied);
    append_copies(g.normals, copied);
    append_copies(g.colors, copied);
    for (GeometryArray<Vec2>& uv : g.uv) append_copies(uv, copied);
}

GeometryPtr without_generated_tangents(const GeometryPtr& geometry) {
    if (!geometry || !geometry->generated_tangents) return geometry;
    auto bare = std::make_shared<Geometry>(*geometry);
    Geometry& g = *bare;
    const std::vector<uint32_t> copies = std::move(g.generated_tangents->copies);
    const size_t vertices = g.positions.size() - copies.size();
    g.serial = next_payload_serial();
    g.generated_tangents.reset();
    g.tangents.clear();
    if (copies.empty()) return bare;
    for (uint32_t& i : g.indices)
        if (i >= vertices) i = copies[i - vertices];
    for (MorphTargetPtr& target : g.targets) {
        auto shorter = std::make_shared<MorphTarget>(*target);
        for (const auto offsets : {&MorphTarget::positions, &MorphTarget::normals, &MorphTarget::tangents})
            drop_copies((*shorter).*offsets, copies.size());
        target = std::move(shorter);
    }
    drop_copies(g.influences, copies.size(), g.influences.size() / g.positions.size());
    drop_copies(g.positions, copies.size());
    drop_copies(g.normals, copies.size());
    drop_copies(g.colors, copies.size());
    for (GeometryArray<Vec2>& uv : g.uv) drop_copies(uv, copies.size());
    return bare;
}

} // namespace blush
