#include "io/gltf/read/nodes.h"

#include "io/gltf/read/extras.h"
#include "io/gltf/read/geometry/instancing.h"
#include "io/gltf/read/ids.h"
#include "io/gltf/read/object.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

std::string node_where(int index) { return fmt::format("nodes[{}]", index); }

std::string node_name(const GltfContext& context, int index) {
    const std::string& name = context.model().nodes[size_t(index)].name;
    return name.empty() ? fmt::format("Node {}", index) : name;
}

// parent[i], or -1. At most one parent per node ensures that the traversal below terminates.
Result<std::vector<int>> find_parents(const GltfContext& context) {
    const auto& nodes = context.model().nodes;
    std::vector<int> parents(nodes.size(), -1);
    for (int i = 0; i < int(nodes.size()); ++i) {
        for (const int child : nodes[size_t(i)].children) {
            if (child < 0 || size_t(child) >= nodes.size())
                return context.error(fmt::format("child {} does not exist; there are {} nodes", child, nodes.size()), node_where(i));
            if (parents[size_t(child)] >= 0)
                return context.error(fmt::format("node {} has two parents, {} and {}", child, parents[size_t(child)], i),
                                     node_where(child));
            parents[size_t(child)] = i;
        }
    }
    return parents;
}

// Depth first with an explicit stack, children in file order.
void walk(const GltfContext& context, int root, bool skip_fallbacks, std::vector<int>& order) {
    std::vector<int> stack{root};
    while (!stack.empty()) {
        const int node = stack.back();
        stack.pop_back();
        if (skip_fallbacks && is_fallback(gltf_item(context.json(), "nodes", size_t(node)))) continue;
        order.push_back(node);
        const std::vector<int>& children = context.model().nodes[size_t(node)].children;
        stack.insert(stack.end(), children.rbegin(), children.rend());
    }
}

// Nodes of all scenes, each once.
Result<std::vector<int>> roots_of_scenes(const GltfContext& context, const std::vector<int>& parents) {
    const tinygltf::Model& model = context.model();
    std::vector<int> roots;
    std::vector<size_t> last_scene(model.nodes.size()); // that lists it, 1-based
    for (size_t s = 0; s < model.scenes.size(); ++s)
        for (const int root : model.scenes[s].nodes) {
            if (root < 0 || size_t(root) >= model.nodes.size())
                return context.error(fmt::format("node {} does not exist; there are {}", root, model.nodes.size()), "scenes.nodes");
            size_t& last = last_scene[size_t(root)];
            if (parents[size_t(root)] >= 0 || last == s + 1)
                return context.error(fmt::format("node {} is listed as a root but is a child, or listed twice", root), "scenes.nodes");
            if (last == 0) roots.push_back(root);
            last = s + 1;
        }
    return roots;
}

// By node: the scenes that list it; empty if all do.
std::vector<std::vector<int32_t>> scenes_by_root(const tinygltf::Model& model) {
    std::vector<std::vector<int32_t>> scenes(model.nodes.size());
    if (model.scenes.size() < 2) return scenes;
    for (size_t s = 0; s < model.scenes.size(); ++s)
        for (const int root : model.scenes[s].nodes) scenes[size_t(root)].push_back(int32_t(s));
    for (std::vector<int32_t>& listed : scenes)
        if (listed.size() == model.scenes.size()) listed.clear();
    return scenes;
}

bool sized(const std::vector<double>& values, size_t size) { return values.empty() || values.size() == size; }

Result<Transform> read_transform(const GltfContext& context, int index) {
    const tinygltf::Node& node = context.model().nodes[size_t(index)];
    const auto broken = [&](const char* what) {
        return context.error(fmt::format("node '{}': {}", node_name(context, index), what), node_where(index));
    };
    if (!sized(node.matrix, 16) || !sized(node.translation, 3) || !sized(node.rotation, 4) || !sized(node.scale, 3))
        return broken("a transform with the wrong number of elements");
    const auto finite_float = [](double v) { return std::isfinite(float(v)); };
    for (const std::vector<double>* values : {&node.matrix, &node.translation, &node.rotation, &node.scale})
        if (!std::all_of(values->begin(), values->end(), finite_float)) return broken("a transform that is not finite");

    if (!node.matrix.empty()) { // column-major
        const std::vector<double>& m = node.matrix;
        if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
            context.warn("the matrix is not affine; its last row is ignored", node_where(index));
        return to_transform({{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}});
    }
    Transform local;
    if (const auto& t = node.translation; !t.empty()) local.translation = {float(t[0]), float(t[1]), float(t[2])};
    if (const auto& s = node.scale; !s.empty()) local.scale = {float(s[0]), float(s[1]), float(s[2])};
    if (const auto& r = node.rotation; !r.empty()) {
        const double size = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
        // Normalised within float precision: kept as it is, so that repeated saves do not change it.
        if (std::abs(size - 1) <= 1e-6)
            local.rotation = {float(r[0]), float(r[1]), float(r[2]), float(r[3])};
        else if (size > 1e-6)
            local.rotation = {float(r[0] / size), float(r[1] / size), float(r[2] / size), float(r[3] / size)};
        else
            context.warn("a rotation of zero length is replaced by the identity", node_where(index));
        if (std::abs(size - 1) > 0.005 && size > 1e-6)
            context.warn(fmt::format("a rotation of length {:.3g} is normalised", size), node_where(index));
    }
    return local;
}

// Morph weights of the node, or else of its mesh.
std::vector<float> read_weights(const GltfContext& context, int index) {
    const tinygltf::Node& node = context.model().nodes[size_t(index)];
    const tinygltf::Mesh& mesh = context.model().meshes[size_t(node.mesh)];
    const std::vector<double>& source = node.weights.empty() ? mesh.weights : node.weights;
    const size_t targets = mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
    if (source.size() > targets) context.warn(fmt::format("{} weights for {} morph targets", source.size(), targets), node_where(index));
    std::vector<float> weights;
    for (size_t i = 0; i < std::min(source.size(), targets); ++i)
        weights.push_back(checked(context, source[i], 0, -any_float, any_float, fmt::format("{}.weights[{}]", node_where(index), i)));
    return weights;
}

// ids[index], or an error if out of range; none for a negative index.
template <class T> Result<Id<T>> target(const GltfContext& context, const std::vector<Id<T>>& ids, int index, const char* kind, int node) {
    if (index < 0) return Id<T>();
    if (size_t(index) >= ids.size())
        return context.error(fmt::format("{} {} does not exist; there are {}", kind, index, ids.size()), node_where(node));
    return ids[size_t(index)];
}

Result<Node> read_node(const GltfContext& context, int index, const NodeTargets& targets, const std::vector<int32_t>& scenes) {
    const tinygltf::Node& source = context.model().nodes[size_t(index)];
    Node node;
    node.name = node_name(context, index);
    const Result<Transform> local = read_transform(context, index);
    if (!local) return local.error();
    node.local = *local;
    const GltfObject extensions(context, source.extensions, node_where(index) + ".extensions");
    const int light_index = extensions.object("KHR_lights_punctual").integer("light").value_or(-1);
    const int area_index = extensions.object("EXT_lights_area").integer("light").value_or(-1);
    const auto mesh = target(context, targets.meshes, source.mesh, "mesh", index);
    const auto light = light_index < 0 ? target(context, targets.lights.area, area_index, "area light", index)
                                       : target(context, targets.lights.punctual, light_index, "light", index);
    const auto measured = targets.lights.ies_lights.by_node.find(index);
    const auto camera = target(context, targets.cameras, source.camera, "camera", index);
    if (!mesh) return mesh.error();
    if (!light) return light.error();
    if (!camera) return camera.error();
    node.mesh = *mesh;
    Result<InstancesPtr> instances = import_instances(context, source, node_where(index));
    if (!instances) return instances.error();
    node.instances = *std::move(instances);
    // An IES light takes precedence over the fallback that the node may have for other programs.
    node.light = measured == targets.lights.ies_lights.by_node.end() ? *light : targets.lights.measured[measured->second];
    node.camera = *camera;
    if (node.mesh) {
        const auto skin = target(context, targets.skins, source.skin, "skin", index);
        if (!skin) return skin.error();
        node.skin = *skin;
        node.morph_weights = read_weights(context, index);
    }
    node.only_in_scenes = scenes;
    node.visible = extensions.object("KHR_node_visibility").boolean("visible", true);
    read_extras(context, gltf_item(context.json(), "nodes", size_t(index)), node, node_where(index));
    return node;
}

uint64_t count_instances(const Scene& scene, const Node& node) {
    const Mesh* mesh = node.instances ? scene.meshes.find(node.mesh) : nullptr;
    return mesh ? uint64_t(node.instances->node_from_copy.size()) * mesh->parts.size() : 0;
}

} // namespace

std::optional<size_t> default_scene(const GltfContext& context) {
    const tinygltf::Model& model = context.model();
    const size_t index = model.defaultScene >= 0 ? size_t(model.defaultScene) : 0;
    return index < model.scenes.size() ? std::optional(index) : std::nullopt;
}

Result<std::vector<int>> reachable_nodes(const GltfContext& context) {
    const tinygltf::Model& model = context.model();
    if (model.defaultScene >= 0 && size_t(model.defaultScene) >= model.scenes.size())
        return context.error(fmt::format("scene {} does not exist; there are {}", model.defaultScene, model.scenes.size()), "scene");
    const Result<std::vector<int>> parents = find_parents(context);
    if (!parents) return parents.error();

    std::vector<int> roots, all;
    for (int i = 0; i < int(model.nodes.size()); ++i)
        if ((*parents)[size_t(i)] < 0) roots.push_back(i);
    for (const int root : roots) walk(context, root, false, all);
    if (all.size() < model.nodes.size()) {
        std::vector<bool> seen(model.nodes.size());
        for (const int node : all) seen[size_t(node)] = true;
        const auto in_cycle = int(std::find(seen.begin(), seen.end(), false) - seen.begin());
        return context.error(fmt::format("node {} is its own ancestor", in_cycle), node_where(in_cycle));
    }

    if (!model.scenes.empty()) {
        const Result<std::vector<int>> listed = roots_of_scenes(context, *parents);
        if (!listed) return listed.error();
        roots = *listed;
        std::vector<int> below;
        for (const int root : roots) walk(context, root, false, below);
        if (below.size() < all.size())
            context.note(fmt::format("ignored: {} nodes that belong to no scene", all.size() - below.size()), "nodes");
    }
    std::vector<int> shown;
    for (const int root : roots) walk(context, root, true, shown);
    return shown;
}

Result<std::vector<Id<Node>>> import_nodes(const GltfContext& context, const std::vector<int>& nodes, const NodeTargets& targets,
                                           Scene& scene) {
    const size_t count = context.model().nodes.size();
    std::vector<std::optional<Node>> read;
    std::vector<uint32_t> wanted;
    uint64_t instances = 0;
    const std::vector<std::vector<int32_t>> scenes = scenes_by_root(context.model());
    for (const int index : nodes) {
        Result<Node> node = read_node(context, index, targets, scenes[size_t(index)]);
        if (!node) return node.error();
        instances += count_instances(scene, *node);
        if (instances > max_instances)
            return context.error(fmt::format("more than {} instances of primitives", max_instances), node_where(index));
        read.push_back(*std::move(node));
        wanted.push_back(requested_id(gltf_item(context.json(), "nodes", size_t(index))));
    }
    // Ids are assigned before nodes are added, since a child may have a lower id than its parent.
    const std::vector<uint32_t> ids = assign_ids(wanted);
    std::vector<Id<Node>> parent_of(count);
    std::vector<Affined> world_from_parent(count);
    for (size_t i = 0; i < nodes.size(); ++i) {
        const auto index = size_t(nodes[i]);
        Node& node = *read[i];
        node.parent = parent_of[index];
        const Affined world_from_node = world_from_parent[index] * to_affine(node.local);
        if (!is_finite(world_from_node))
            return context.error(fmt::format("node '{}': its world transform is not finite", node.name), node_where(nodes[i]));
        for (const int child : context.model().nodes[index].children) {
            parent_of[size_t(child)] = Id<Node>{ids[i]};
            world_from_parent[size_t(child)] = world_from_node;
        }
    }
    return add_with_ids(scene.nodes, std::move(read), wanted);
}

} // namespace blush
