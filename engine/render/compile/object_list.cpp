#include "render/compile/object_list.h"

#include "render/compile/deformed_meshes.h"
#include "render/compile/expanded_lights.h"
#include "scene/affine.h"
#include "scene/world_transforms.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace blush {
namespace {

// Embree's medium-quality builder needs about 0.15 ms per thousand triangles on one thread: moving an object takes below 20 ms.
constexpr size_t max_flat_mesh_triangles = 32768;
constexpr size_t max_flat_scene_triangles = 131072;

} // namespace

bool SceneObject::same_shape(const SceneObject& other) const {
    const auto same_part = [](const MeshPart& a, const MeshPart& b) {
        return a.geometry->serial == b.geometry->serial && a.material == b.material;
    };
    return node == other.node && instanced == other.instanced && instances == other.instances && places.size() == other.places.size() &&
           std::equal(parts.begin(), parts.end(), other.parts.begin(), other.parts.end(), same_part);
}

size_t SceneObject::triangle_count() const {
    size_t n = 0;
    for (const MeshPart& part : parts) n += part.geometry->triangle_count();
    return n;
}

Affined SceneObject::world_from_copy(size_t copy) const {
    if (!places.empty()) return places[copy];
    return instances ? world_from_object * to_double(instances->node_from_copy[copy]) : world_from_object;
}

std::string node_label(const Scene& scene, Id<Node> id) {
    const Node* node = scene.nodes.find(id);
    return node && !node->name.empty() ? fmt::format("node \"{}\"", node->name) : fmt::format("node {}", id.value);
}

std::vector<SceneObject> list_objects(const Scene& scene, std::vector<Diagnostic>* left_out) {
    std::vector<SceneObject> objects;
    std::map<Id<Mesh>, int> uses;
    WorldTransforms transforms(scene);
    for (const auto& [id, node] : scene.nodes) {
        const Mesh* mesh = node.mesh ? scene.meshes.find(node.mesh) : nullptr;
        if (!mesh || !transforms(id).visible) continue;
        SceneObject object{id, {}, world_from_mesh(scene, transforms, id, node), false, node.instances, is_disabled_mesh(scene, id)};
        for (const MeshPart& part : mesh->parts)
            if (part.geometry && part.geometry->triangle_count() > 0) object.parts.push_back(part);
        if (object.parts.empty() || object.copies() == 0) continue;
        if (!is_finite(object.world_from_object)) {
            if (left_out)
                left_out->push_back(
                    {Diagnostic::Severity::warning, "an object is not rendered: its transform is not finite", node_label(scene, id)});
            continue;
        }
        ++uses[node.mesh];
        objects.push_back(std::move(object));
    }
    size_t flat = 0;
    for (SceneObject& object : objects) {
        const size_t n = object.triangle_count();
        object.instanced = object.instances || uses[scene.nodes.find(object.node)->mesh] > 1 || n > max_flat_mesh_triangles ||
                           flat + n > max_flat_scene_triangles;
        if (!object.instanced) flat += n;
    }
    std::stable_partition(objects.begin(), objects.end(), [](const SceneObject& o) { return !o.instanced; });
    return objects;
}

} // namespace blush
