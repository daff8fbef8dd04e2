#include "io/gltf/write/write_animations.h"

#include "io/gltf/write/write_payloads.h"

#include <algorithm>
#include <map>

namespace blush {
namespace {

using Property = Channel::Property;

constexpr std::string_view path_of(Property property) {
    switch (property) {
    case Property::translation: return "translation";
    case Property::rotation: return "rotation";
    case Property::scale: return "scale";
    case Property::morph_weights: return "weights";
    }
    return {};
}

constexpr std::string_view enum_to_string(Keyframes::Interpolation interpolation) {
    switch (interpolation) {
    case Keyframes::Interpolation::step: return "STEP";
    case Keyframes::Interpolation::linear: return "LINEAR";
    case Keyframes::Interpolation::cubic_spline: return "CUBICSPLINE";
    }
    return {};
}

// Not a vertex attribute: its buffer view has no target.
int append_plain(GltfDocument& document, const float* values, size_t count, int components, bool with_bounds) {
    const int accessor = append_floats(document, values, count, components, with_bounds);
    erase(document.object("bufferViews", document.object("accessors", accessor).at("bufferView").get<int>()), "target");
    return accessor;
}

// A skin with deleted joints cannot be written.
bool has_all_joints(const GltfDocument& document, const Skin& skin) {
    return !skin.joints.empty() && std::ranges::all_of(skin.joints, [&](Id<Node> joint) { return document.indices.nodes.contains(joint); });
}

Json skin_of(GltfDocument& document, const Skin& skin) {
    Json joints = Json::array();
    std::vector<float> matrices;
    for (size_t j = 0; j < skin.joints.size(); ++j) {
        joints.push_back(document.indices.nodes.at(skin.joints[j]));
        const Affine& m = skin.joint_from_mesh[j];
        matrices.insert(matrices.end(), {m.x.x, m.x.y, m.x.z, 0, m.y.x, m.y.y, m.y.z, 0, m.z.x, m.z.y, m.z.z, 0, m.t.x, m.t.y, m.t.z, 1});
    }
    return {{"name", skin.name},
            {"inverseBindMatrices", append_plain(document, matrices.data(), skin.joints.size(), 16, false)},
            {"joints", std::move(joints)}};
}

Json sampler_of(GltfDocument& document, const Channel& channel) {
    const Keyframes& k = *channel.keyframes;
    const int components = channel.property == Property::morph_weights ? 1 : channel.property == Property::rotation ? 4 : 3;
    const int input = append_plain(document, k.times.data(), k.times.size(), 1, true);
    const int output = append_plain(document, k.values.data(), k.values.size() / size_t(components), components, false);
    return {{"input", input}, {"output", output}, {"interpolation", enum_to_string(k.interpolation)}};
}

using Target = std::pair<int, std::string>; // node and path

// Sampler of each target in the animation.
std::map<Target, int> samplers_in(const Json& animation) {
    std::map<Target, int> samplers;
    for (const Json& channel : child_or_null(animation, "channels")) {
        Target target{-1, {}};
        int sampler = -1;
        const Json& says = child_or_null(channel, "target");
        if (read_json(child_or_null(says, "node"), target.first) && read_json(child_or_null(says, "path"), target.second) &&
            read_json(child_or_null(channel, "sampler"), sampler))
            samplers.emplace(target, sampler);
    }
    return samplers;
}

// Adds missing channels; channels with equal keyframes share a sampler. True if any was added.
bool add_channels(GltfDocument& document, const Clip& clip, Json& animation) {
    const std::map<Target, int> said = samplers_in(animation);
    std::map<const Keyframes*, int> samplers;
    std::vector<std::pair<Target, const Channel*>> missing;
    for (const Channel& channel : clip.channels) {
        const auto node = document.indices.nodes.find(channel.node);
        if (node == document.indices.nodes.end()) continue;
        const Target target{node->second, path_of(channel.property)};
        if (const auto there = said.find(target); there != said.end())
            samplers[channel.keyframes.get()] = there->second;
        else
            missing.emplace_back(target, &channel);
    }
    for (const auto& [target, channel] : missing) {
        const auto [sampler, is_new] = samplers.try_emplace(channel->keyframes.get(), int(child_or_null(animation, "samplers").size()));
        if (is_new) animation["samplers"].push_back(sampler_of(document, *channel));
        animation["channels"].push_back({{"sampler", sampler->second}, {"target", {{"node", target.first}, {"path", target.second}}}});
    }
    return !missing.empty();
}

} // namespace

void write_skins(GltfDocument& document, const Scene& scene) {
    for (const auto& [id, node] : scene.nodes) {
        const Skin* skin = node.mesh && node.skin ? scene.skins.find(node.skin) : nullptr;
        if (skin && !document.indices.skins.contains(node.skin) && has_all_joints(document, *skin))
            document.indices.skins[node.skin] = document.append("skins", skin_of(document, *skin));
        const auto index = skin ? document.indices.skins.find(node.skin) : document.indices.skins.end();
        set_index(document.object("nodes", document.indices.nodes.at(id)), "skin",
                  index == document.indices.skins.end() ? -1 : index->second);
    }
}

void write_animations(GltfDocument& document, const Scene& scene) {
    for (const auto& [id, clip] : scene.clips) {
        const auto known = document.indices.clips.find(id);
        Json animation = known == document.indices.clips.end() ? Json{{"name", clip.name}} : document.object("animations", known->second);
        if (!add_channels(document, clip, animation)) continue;
        if (known == document.indices.clips.end())
            document.indices.clips[id] = document.append("animations", std::move(animation));
        else
            document.object("animations", known->second) = std::move(animation);
    }
}

} // namespace blush
