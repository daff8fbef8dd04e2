#include "io/gltf/read/geometry/deform.h"

#include "io/gltf/read/geometry/accessors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <span>

namespace blush {
namespace {

// Reads an accessor with one vector per vertex.
Result<FloatArray> read_per_vertex(const GltfContext& context, int accessor, int components, size_t vertices, const std::string& where) {
    Result<FloatArray> array = read_floats(context, accessor, components, components, where);
    if (array && array->count() != vertices)
        return context.error(fmt::format("{} elements for {} positions", array->count(), vertices), where);
    return array;
}

// Returns the number of values that were not finite.
size_t zero_non_finite(std::vector<float>& values) {
    size_t bad = 0;
    for (float& v : values) {
        if (std::isfinite(v)) continue;
        v = 0;
        ++bad;
    }
    return bad;
}

Result<std::vector<Vec3>> read_offsets(const GltfContext& context, const std::map<std::string, int>& target, const char* name,
                                       size_t vertices, const std::string& where) {
    std::vector<Vec3> offsets;
    const auto accessor = target.find(name);
    if (accessor == target.end()) return offsets;
    Result<FloatArray> array = read_per_vertex(context, accessor->second, 3, vertices, where);
    if (!array) return array.error();
    if (const size_t bad = zero_non_finite(array->values)) context.warn(fmt::format("{} non-finite offsets are replaced by 0", bad), where);
    for (size_t i = 0; i < vertices; ++i) offsets.push_back({array->values[3 * i], array->values[3 * i + 1], array->values[3 * i + 2]});
    return offsets;
}

Result<void> read_targets(const GltfContext& context, const tinygltf::Primitive& primitive, Geometry& g, const std::string& where) {
    for (size_t t = 0; t < primitive.targets.size(); ++t) {
        const std::string target_where = fmt::format("{}.targets[{}]", where, t);
        auto target = std::make_shared<MorphTarget>();
        for (const auto& [name, into] : {std::pair{"POSITION", &MorphTarget::positions}, std::pair{"NORMAL", &MorphTarget::normals},
                                         std::pair{"TANGENT", &MorphTarget::tangents}}) {
            Result<std::vector<Vec3>> offsets = read_offsets(context, primitive.targets[t], name, g.positions.size(), target_where);
            if (!offsets) return offsets.error();
            (*target).*into = *std::move(offsets);
        }
        for (const auto& [name, accessor] : primitive.targets[t])
            if (name != "POSITION" && name != "NORMAL" && name != "TANGENT")
                context.note(
                    fmt::format("ignored: {} of a morph target; only positions, normals and tangents are morphed", name.substr(0, 100)),
                    target_where);
        g.targets.push_back(std::move(target));
    }
    return {};
}

// Normalises the weights of one vertex; false if they change by more than 8-bit rounding.
bool normalize(Influence* influences, size_t count) {
    double sum = 0;
    for (size_t k = 0; k < count; ++k) sum += influences[k].weight;
    if (!(sum > 0)) {
        influences[0] = {0, 1};
        return false;
    }
    // Normalised within float precision: kept as they are, so that repeated saves do not change them.
    if (std::abs(sum - 1) <= 1e-6) return true;
    for (size_t k = 0; k < count; ++k) influences[k].weight = float(influences[k].weight / sum);
    return std::abs(sum - 1) <= double(count) / 255;
}

Result<void> read_influences(const GltfContext& context, const tinygltf::Primitive& primitive, Geometry& g, const std::string& where) {
    const size_t vertices = g.positions.size();
    std::vector<FloatArray> joints, weights;
    for (size_t set = 0; set < primitive.attributes.size(); ++set) {
        const auto j = primitive.attributes.find(fmt::format("JOINTS_{}", set)),
                   w = primitive.attributes.find(fmt::format("WEIGHTS_{}", set));
        if (j == primitive.attributes.end() || w == primitive.attributes.end()) break;
        Result<FloatArray> joint = read_per_vertex(context, j->second, 4, vertices, where + ".JOINTS");
        if (!joint) return joint.error();
        Result<FloatArray> weight = read_per_vertex(context, w->second, 4, vertices, where + ".WEIGHTS");
        if (!weight) return weight.error();
        joints.push_back(*std::move(joint));
        weights.push_back(*std::move(weight));
    }
    const size_t lone =
        size_t(std::ranges::count_if(primitive.attributes, [](const auto& a) { return is_influence(a.first); })) - 2 * joints.size();
    if (lone > 0) context.warn(fmt::format("ignored: {} sets of JOINTS_n or WEIGHTS_n without their counterpart", lone), where);
    const size_t per_vertex = 4 * joints.size();
    if (per_vertex == 0) return {};
    size_t bad = 0, unequal = 0;
    for (size_t i = 0; i < vertices; ++i) {
        for (size_t k = 0; k < per_vertex; ++k) {
            const float joint = joints[k / 4].values[4 * i + k % 4], weight = weights[k / 4].values[4 * i + k % 4];
            const bool good = joint >= 0 && joint <= 65535 && std::isfinite(weight) && weight >= 0;
            bad += !good;
            g.influences.push_back(good ? Influence{uint16_t(joint), weight} : Influence{});
        }
        unequal += !normalize(g.influences.data() + i * per_vertex, per_vertex);
    }
    if (bad) context.warn(fmt::format("ignored: {} invalid joints or weights", bad), where);
    if (unequal) context.warn(fmt::format("the skinning weights of {} vertices do not sum to 1 and are normalised", unequal), where);
    return {};
}

// Values of the vertices `of`, `per_vertex` each.
template <class V> std::vector<V> picked(const std::vector<V>& values, std::span<const uint32_t> of, size_t per_vertex = 1) {
    std::vector<V> result;
    if (values.empty()) return result;
    result.reserve(of.size() * per_vertex);
    for (const uint32_t i : of)
        result.insert(result.end(), values.begin() + std::ptrdiff_t(i * per_vertex), values.begin() + std::ptrdiff_t((i + 1) * per_vertex));
    return result;
}

} // namespace

bool is_influence(const std::string& attribute) { return attribute.starts_with("JOINTS_") || attribute.starts_with("WEIGHTS_"); }

Result<void> read_deformation(const GltfContext& context, const tinygltf::Primitive& primitive, Geometry& g, const std::string& where) {
    if (const auto ok = read_targets(context, primitive, g, where); !ok) return ok;
    return read_influences(context, primitive, g, where);
}

void limit_deformation(const GltfContext& context, Scene& scene) {
    const auto deformed_vertices = [&](const Node& node) {
        const Mesh* mesh = scene.meshes.find(node.mesh);
        size_t count = 0;
        for (size_t p = 0; mesh && p < mesh->parts.size(); ++p)
            if (const Geometry* g = mesh->parts[p].geometry.get(); g && (!g->targets.empty() || (node.skin && !g->influences.empty())))
                count += g->positions.size();
        return count;
    };
    std::set<Id<Node>> at_rest;
    size_t sum = 0;
    for (const auto& [id, node] : scene.nodes) {
        const size_t count = deformed_vertices(node);
        sum += count;
        if (count > 0 && sum > max_deformed_vertices) at_rest.insert(id);
    }
    if (at_rest.empty()) return;
    for (const Id<Node> id : at_rest) {
        Node node = *scene.nodes.find(id);
        node.skin = {};
        node.morph_weights.clear();
        scene.nodes.set(id, std::move(node));
    }
    const Table<Clip> clips = scene.clips;
    for (auto [id, clip] : clips) {
        std::erase_if(clip.channels,
                      [&](const Channel& c) { return c.property == Channel::Property::morph_weights && at_rest.contains(c.node); });
        scene.clips.set(id, std::move(clip));
    }
    context.warn(fmt::format("ignored: skins and morph targets of {} nodes; the limit is {} deformed vertices", at_rest.size(),
                             max_deformed_vertices),
                 "nodes");
}

void unweld_deformation(Geometry& g) {
    for (MorphTargetPtr& target : g.targets)
        target = std::make_shared<const MorphTarget>(
            MorphTarget{picked(target->positions, g.indices), picked(target->normals, g.indices), picked(target->tangents, g.indices)});
    if (!g.influences.empty()) g.influences = picked(g.influences, g.indices, g.influences.size() / g.positions.size());
}

} // namespace blush
