#include "render/compile/tangent_meshes.h"

#include "scene/geometry/arena_geometry.h"
#include "scene/geometry/tangents.h"

#include <optional>

namespace blush {
namespace {

// Null if the geometry lacks the inputs for tangents.
GeometryPtr with_tangents(const GeometryPtr& geometry, int uv_set) {
    const GeometryPtr bare = without_generated_tangents(geometry);
    if (!bare->has_uv_set(uv_set)) return bare;
    auto made = std::make_shared<Geometry>(*bare);
    made->serial = next_payload_serial();
    add_tangents(*made, uv_set);
    move_to_arena(*made);
    return made;
}

// True if the tangents differ from those that import would have made for this UV set.
bool is_to_change(const Geometry& g, int uv_set) {
    if (uv_set < 0 || g.normals.empty()) return false;
    if (g.tangents.empty()) return g.has_uv_set(uv_set);
    return g.generated_tangents && g.generated_tangents->uv_set != uv_set;
}

} // namespace

void TangentMeshes::provide(Scene& scene) {
    std::map<Key, GeometryPtr> used;
    if (any_needs_tangents(scene)) {
        const Table<Mesh> meshes = scene.meshes;
        for (const auto& [id, mesh] : meshes) {
            std::optional<Mesh> dressed;
            for (size_t p = 0; p < mesh.parts.size(); ++p) {
                const GeometryPtr& geometry = mesh.parts[p].geometry;
                const int set = tangent_uv_set(scene, mesh.parts[p]);
                if (!geometry || !is_to_change(*geometry, set)) continue;
                GeometryPtr& made = used[{geometry->serial, set}];
                if (const auto before = known_.find({geometry->serial, set}); !made && before != known_.end()) made = before->second;
                if (!made) made = with_tangents(geometry, set);
                if (!dressed) dressed = mesh;
                dressed->parts[p].geometry = made;
            }
            if (dressed) scene.meshes.set(id, *std::move(dressed));
        }
    }
    known_ = std::move(used);
}

} // namespace blush
