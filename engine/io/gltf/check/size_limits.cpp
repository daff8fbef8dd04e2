#include "io/gltf/check/size_limits.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace blush {
namespace {

// Limits of the decoded size: always allowed, and as a multiple of the buffers' size. Valid files whose primitives share one
// vertex array reach dozens.
constexpr double free_bytes = 128e6, max_decoded_ratio = 64;

// Every component is decoded to a float. Unreadable accessors are reported when they are read.
double bytes_of(const GltfContext& context, int index) {
    const auto& accessors = context.model().accessors;
    if (index < 0 || size_t(index) >= accessors.size()) return 0;
    const tinygltf::Accessor& accessor = accessors[size_t(index)];
    if (accessor.count > std::numeric_limits<uint32_t>::max()) return 0;
    return 4.0 * double(accessor.count) * std::max(1, tinygltf::GetNumComponentsInType(uint32_t(accessor.type)));
}

} // namespace

double decoded_bytes(const GltfContext& context, const tinygltf::Primitive& primitive) {
    double bytes = bytes_of(context, primitive.indices);
    for (const auto& [name, accessor] : primitive.attributes) bytes += bytes_of(context, accessor);
    for (const auto& target : primitive.targets)
        for (const auto& [name, accessor] : target) bytes += bytes_of(context, accessor);
    return bytes;
}

Result<void> check_size_limits(const GltfContext& context, const std::vector<int>& nodes) {
    const tinygltf::Model& model = context.model();
    std::vector<bool> counted(model.meshes.size());
    double asked = 0;
    for (const int node : nodes) {
        const int mesh = model.nodes[size_t(node)].mesh;
        if (mesh < 0 || size_t(mesh) >= counted.size() || counted[size_t(mesh)]) continue;
        counted[size_t(mesh)] = true;
        for (const tinygltf::Primitive& primitive : model.meshes[size_t(mesh)].primitives) asked += decoded_bytes(context, primitive);
    }
    for (const tinygltf::Animation& animation : model.animations)
        for (const tinygltf::AnimationSampler& sampler : animation.samplers)
            asked += bytes_of(context, sampler.input) + bytes_of(context, sampler.output);
    for (const tinygltf::Skin& skin : model.skins) asked += bytes_of(context, skin.inverseBindMatrices);
    const double there = context.source.bytes_in_buffers();
    if (asked <= free_bytes + max_decoded_ratio * there) return {};
    return context.error(
        fmt::format("its meshes and animations need {:.0f} MB when decoded, but its buffers have only {:.3g} MB", asked / 1e6, there / 1e6),
        "accessors");
}

} // namespace blush
