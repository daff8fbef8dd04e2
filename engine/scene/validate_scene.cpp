#include "scene/affine.h"
#include "scene/animation/keyframes.h"
#include "scene/document/scene_selection.h"
#include "scene/reference_check.h"
#include "scene/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace blush {
namespace {

template <class T> Result<void> validate_records(const Table<T>& table) {
    for (const auto& [id, record] : table)
        if (auto valid = validate(record); !valid) return valid;
    return {};
}

template <class T> Result<void> check_all_references(const Scene& scene, const Table<T>& table) {
    for (const auto& [id, record] : table)
        if (auto known = check_references(scene, record); !known) return known;
    return {};
}

bool array_fits(size_t size, size_t positions) { return size == 0 || size == positions; }

bool is_whole(const Geometry& g) {
    const size_t n = g.positions.size();
    return array_fits(g.normals.size(), n) && array_fits(g.tangents.size(), n) && array_fits(g.colors.size(), n) &&
           std::ranges::all_of(g.uv, [n](const auto& uv) { return array_fits(uv.size(), n); }) && g.indices.size() % 3 == 0 &&
           std::ranges::all_of(g.indices, [n](uint32_t i) { return i < n; }) && (n == 0 || g.influences.size() % n == 0) &&
           std::ranges::all_of(g.targets, [n](const MorphTargetPtr& t) {
               return t && array_fits(t->positions.size(), n) && array_fits(t->normals.size(), n) && array_fits(t->tangents.size(), n);
           });
}

bool is_whole(const Channel& channel) {
    const Keyframes* k = channel.keyframes.get();
    if (!k || k->times.empty() || k->values.size() % k->times.size() != 0 || !std::ranges::is_sorted(k->times)) return false;
    const auto finite = [](float v) { return std::isfinite(v); };
    if (!std::ranges::all_of(k->times, finite) || !std::ranges::all_of(k->values, finite)) return false;
    using Property = Channel::Property;
    if (channel.property == Property::morph_weights) return true;
    return width_of(*k) == (channel.property == Property::rotation ? 4 : 3);
}

// Returns a node that is its own ancestor, or none. All parents must exist. O(n): visits each node once.
Id<Node> find_cycle(const Scene& scene) {
    std::unordered_map<uint32_t, Id<Node>> seen_from; // the node whose walk to the root visited this one first
    for (const auto& [start, unused] : scene.nodes)
        for (Id<Node> id = start; id; id = scene.nodes.find(id)->parent) {
            const auto [seen, is_new] = seen_from.try_emplace(id.value, start);
            if (!is_new && seen->second == start) return id;
            if (!is_new) break;
        }
    return {};
}

} // namespace

Result<void> validate(const Mesh& mesh) {
    for (const MeshPart& part : mesh.parts)
        if (!part.geometry || !is_whole(*part.geometry))
            return Error{.what = "inconsistent array sizes or indices", .where = fmt::format("mesh \"{}\"", mesh.name)};
    return {};
}

Result<void> validate(const Skin& skin) {
    const bool good = skin.joints.size() == skin.joint_from_mesh.size() &&
                      std::ranges::all_of(skin.joint_from_mesh, [](const Affine& m) { return is_finite(to_double(m)); });
    if (good) return {};
    return Error{.what = "each joint needs a finite inverse bind matrix", .where = fmt::format("skin \"{}\"", skin.name)};
}

Result<void> validate(const Clip& clip) {
    const auto order = [](const Channel& a, const Channel& b) { return std::pair(a.node, a.property) < std::pair(b.node, b.property); };
    const bool good = clip.seconds >= 0 && std::isfinite(clip.seconds) && std::ranges::is_sorted(clip.channels, order) &&
                      std::ranges::all_of(clip.channels, [](const Channel& channel) { return is_whole(channel); });
    if (good) return {};
    return Error{.what = "times, keyframes and channels are inconsistent", .where = fmt::format("clip \"{}\"", clip.name)};
}

Result<void> validate(const Scene& scene) {
    if (auto valid = validate_records(scene.nodes); !valid) return valid;
    if (auto valid = validate_records(scene.meshes); !valid) return valid;
    if (auto valid = validate_records(scene.materials); !valid) return valid;
    if (auto valid = validate_records(scene.textures); !valid) return valid;
    if (auto valid = validate_records(scene.lights); !valid) return valid;
    if (auto valid = validate_records(scene.cameras); !valid) return valid;
    if (auto valid = validate_records(scene.skins); !valid) return valid;
    if (auto valid = validate_records(scene.clips); !valid) return valid;
    if (auto valid = check_scene_selection(scene, scene.scene_selection); !valid) return valid;
    if (auto valid = validate(scene.environment); !valid) return valid;
    if (auto valid = validate(scene.mix); !valid) return valid;
    if (auto valid = validate(scene.view.lens); !valid) return valid;
    if (auto known = check_all_references(scene, scene.nodes); !known) return known;
    if (auto known = check_all_references(scene, scene.meshes); !known) return known;
    if (auto known = check_all_references(scene, scene.materials); !known) return known;
    if (const Node* node = scene.nodes.find(find_cycle(scene)))
        return Error{.what = "a node cannot be its own ancestor", .where = fmt::format("node \"{}\"", node->name)};
    return {};
}

} // namespace blush
