#include "render/tangent_meshes.h"

#include "scene/tangents.h"

#include <optional>

namespace blush {
namespace {

GeometryPtr with_tangents(const Geometry& bare, int uv_set) {
    auto made = std::make_shared<Geometry>(bare);
    made->serial = next_payload_serial();
    add_tangents(*made, uv_set);
    return made;
}

} // namespace

void TangentMeshes::provide(Scene& scene) {
    std::map<Key, GeometryPtr> used;
    if (any_needs_tangents(scene)) {
        const Table<Mesh> meshes = scene.meshes;
        for (const auto& [id, mesh] : meshes) {
            std::optional<Mesh> dressed;
            for (size_t p = 0; p < mesh.parts.size(); ++p) {
                const Geometry* bare = mesh.parts[p].geometry.get();
                if (!bare || !bare->tangents.empty() || bare->normals.empty()) continue;
                const int set = tangent_uv_set(scene, mesh.parts[p]);
                if (set < 0 || !bare->has_uv_set(set)) continue;
                GeometryPtr& made = used[{bare->serial, set}];
                if (const auto before = known_.find({bare->serial, set}); !made && before != known_.end()) made = before->second;
                if (!made) made = with_tangents(*bare, set);
                if (!dressed) dressed = mesh;
                dressed->parts[p].geometry = made;
            }
            if (dressed) scene.meshes.set(id, *std::move(dressed));
        }
    }
    known_ = std::move(used);
}

} // namespace blush
