#include "tests/bench/edits.h"

#include "render/materials/smoothness.h"

#include <algorithm>
#include <cmath>

namespace blush::bench {
namespace {

// 1 plus a little more at each step.
float grown(int step) { return 1 + 0.01f * float(step); }

bool emits(const Material& m) { return std::max({m.emissive.x, m.emissive.y, m.emissive.z}) * m.emissive_strength > 0; }

template <class T, class Predicate> Id<T> find_if(const Table<T>& table, const Predicate& predicate) {
    for (const auto& [id, value] : table)
        if (predicate(value)) return id;
    return {};
}

Id<Light> a_light(const Scene& scene) {
    for (const auto& [id, node] : scene.nodes)
        if (const Light* light = scene.lights.find(node.light); light && light->enabled && is_visible(scene, id)) return node.light;
    return {};
}

// A visible mesh that does not emit.
Id<Node> an_object(const Scene& scene) {
    for (const auto& [id, node] : scene.nodes) {
        const Mesh* mesh = scene.meshes.find(node.mesh);
        if (!mesh || !is_visible(scene, id)) continue;
        const bool emitting = std::any_of(mesh->parts.begin(), mesh->parts.end(), [&](const MeshPart& part) {
            const Material* material = scene.materials.find(part.material);
            return material && emits(*material);
        });
        if (!emitting) return id;
    }
    return {};
}

std::function<void(Scene&, int)> light_edit(const Scene& scene) {
    if (const Id<Light> id = a_light(scene))
        return [id, light = *scene.lights.find(id)](Scene& s, int step) {
            Light changed = light;
            changed.intensity *= grown(step);
            s.lights.set(id, changed);
        };
    if (const Id<Material> id = find_if(scene.materials, emits))
        return [id, material = *scene.materials.find(id)](Scene& s, int step) {
            Material changed = material;
            changed.emissive_strength *= grown(step);
            s.materials.set(id, changed);
        };
    if (scene.environment.kind != Environment::Kind::none)
        return [intensity = scene.environment.intensity](Scene& s, int step) { s.environment.intensity = intensity * grown(step); };
    return {};
}

std::function<void(Scene&, int)> material_edit(const Scene& scene) {
    const Id<Material> id = find_if(scene.materials, [](const Material& m) { return !emits(m); });
    if (!id) return {};
    return [id, material = *scene.materials.find(id)](Scene& s, int step) {
        Material changed = material;
        for (float* component : {&changed.base_color.x, &changed.base_color.y, &changed.base_color.z}) *component /= grown(step);
        s.materials.set(id, changed);
    };
}

std::function<void(Scene&, int)> camera_edit(const Scene& scene) {
    return [view = scene.view](Scene& s, int step) { s.view.position.x = view.position.x + 0.001f * view.pivot_distance * float(step); };
}

std::function<void(Scene&, int)> object_edit(const Scene& scene) {
    const Id<Node> id = an_object(scene);
    if (!id) return {};
    return [id, node = *scene.nodes.find(id)](Scene& s, int step) {
        Node moved = node;
        const Affined was = to_affine(node.local);
        Affined now = was;
        now.t.x += 0.001 * double(step) * std::max(1e-3, world_bounds(s, id).radius());
        moved.local = to_transform(now);
        s.nodes.set(id, moved);
    };
}

// An even environment looks the same when it is turned.
std::function<void(Scene&, int)> environment_edit(const Scene& scene) {
    if (scene.environment.kind == Environment::Kind::none) return {};
    return [environment = scene.environment](Scene& s, int step) {
        if (environment.kind == Environment::Kind::constant)
            s.environment.intensity = environment.intensity * grown(step);
        else
            s.environment.rotation_degrees = environment.rotation_degrees + float(step);
    };
}

std::function<void(Scene&, int)> colour_edit(const Scene& scene) {
    if (const Id<Light> id = a_light(scene))
        return [id, light = *scene.lights.find(id)](Scene& s, int step) {
            Light changed = light;
            changed.color.z /= grown(step);
            s.lights.set(id, changed);
        };
    if (const Id<Material> id = find_if(scene.materials, emits))
        return [id, material = *scene.materials.find(id)](Scene& s, int step) {
            Material changed = material;
            changed.emissive.z /= grown(step);
            s.materials.set(id, changed);
        };
    return {};
}

// A node with a light or an emitting mesh.
Id<Node> an_emitter(const Scene& scene) {
    for (const auto& [id, node] : scene.nodes) {
        if (!is_visible(scene, id)) continue;
        if (const Light* light = scene.lights.find(node.light); light && light->enabled) return id;
        const Mesh* mesh = scene.meshes.find(node.mesh);
        if (mesh && std::ranges::any_of(mesh->parts, [&](const MeshPart& part) {
                const Material* material = scene.materials.find(part.material);
                return material && emits(*material);
            }))
            return id;
    }
    return {};
}
Id<Node> a_caster(const Scene& scene) {
    for (const auto& [id, node] : scene.nodes) {
        const Mesh* mesh = scene.meshes.find(node.mesh);
        if (mesh && is_visible(scene, id) && std::ranges::any_of(mesh->parts, [&](const MeshPart& part) {
                const Material* material = scene.materials.find(part.material);
                return material && smoothness_of(*material).casts_caustics > 0;
            }))
            return id;
    }
    return {};
}

// Turns about the axes of the world by a thousandth of a radian, and moves by a thousandth of the scene's radius, a step.
std::function<void(Scene&, int)> node_edit(const Scene& scene, Id<Node> id, bool turn, double radius) {
    if (!id) return {};
    return [id, turn, radius, node = *scene.nodes.find(id)](Scene& s, int step) {
        Node moved = node;
        Affined now = to_affine(node.local);
        if (turn) {
            const double a = 0.001 * double(step), c = std::cos(a), d = std::sin(a);
            for (Vec3d* axis : {&now.x, &now.y, &now.z}) *axis = {axis->x, c * axis->y - d * axis->z, d * axis->y + c * axis->z};
        }
        now.t.x += 0.001 * double(step) * radius;
        moved.local = to_transform(now);
        s.nodes.set(id, moved);
    };
}

} // namespace

std::vector<EditKind> edits_after_learning(const Scene& scene) {
    std::vector<EditKind> kinds{
        {"light", light_edit(scene)},
        {"colour", colour_edit(scene)},
        {"material", material_edit(scene)},
        {"camera", camera_edit(scene)},
        {"light moved", node_edit(scene, an_emitter(scene), true, world_bounds(scene).radius())},
        {"caster moved", node_edit(scene, a_caster(scene), false, a_caster(scene) ? world_bounds(scene, a_caster(scene)).radius() : 1)},
        {"object", object_edit(scene)}};
    std::erase_if(kinds, [](const EditKind& kind) { return !kind.apply; });
    return kinds;
}

std::vector<EditKind> edits_of(const Scene& scene) {
    std::vector<EditKind> kinds{{"light", light_edit(scene)},
                                {"material", material_edit(scene)},
                                {"camera", camera_edit(scene)},
                                {"object", object_edit(scene)},
                                {"environment", environment_edit(scene)}};
    std::erase_if(kinds, [](const EditKind& kind) { return !kind.apply; });
    return kinds;
}

} // namespace blush::bench
