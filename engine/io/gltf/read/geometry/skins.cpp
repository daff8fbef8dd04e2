#include "io/gltf/read/geometry/skins.h"

#include "io/gltf/read/extras.h"
#include "io/gltf/read/geometry/accessors.h"
#include "io/gltf/read/ids.h"
#include "scene/affine.h"

namespace blush {
namespace {

Affine column_major(const float* m) { return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}}; }

Result<std::vector<Affine>> read_inverse_binds(const GltfContext& context, const tinygltf::Skin& source, const std::string& where) {
    std::vector<Affine> matrices(source.joints.size());
    if (source.inverseBindMatrices < 0 || context.known) return matrices;
    const Result<FloatArray> array = read_floats(context, source.inverseBindMatrices, 16, 16, where + ".inverseBindMatrices");
    if (!array) return array.error();
    if (array->count() < matrices.size())
        context.warn(fmt::format("{} inverse bind matrices for {} joints: the others are the identity", array->count(), matrices.size()),
                     where);
    size_t bad = 0, skewed = 0;
    for (size_t j = 0; j < std::min(matrices.size(), array->count()); ++j) {
        const float* elements = array->values.data() + 16 * j;
        const Affine m = column_major(elements);
        skewed += elements[3] != 0 || elements[7] != 0 || elements[11] != 0 || elements[15] != 1;
        const bool good = is_finite(to_double(m));
        bad += !good;
        if (good) matrices[j] = m;
    }
    if (bad) context.warn(fmt::format("{} non-finite inverse bind matrices are replaced by the identity", bad), where);
    if (skewed) context.warn(fmt::format("{} inverse bind matrices are not affine; their last row is ignored", skewed), where);
    return matrices;
}

// Number of joints that the vertices of each mesh need: the largest joint index + 1.
std::map<Id<Mesh>, size_t> joints_named(const Scene& scene) {
    std::map<Id<Mesh>, size_t> named;
    for (const auto& [id, mesh] : scene.meshes)
        for (const MeshPart& part : mesh.parts)
            if (part.geometry)
                for (const Influence& by : part.geometry->influences)
                    if (by.weight > 0) named[id] = std::max(named[id], size_t(by.joint) + 1);
    return named;
}

// Warns about vertices that use joints beyond those of their node's skin.
void report_stray_vertices(const GltfContext& context, const Scene& scene) {
    const std::map<Id<Mesh>, size_t> named = joints_named(scene);
    for (const auto& [id, node] : scene.nodes) {
        const Skin* skin = node.skin ? scene.skins.find(node.skin) : nullptr;
        const auto joints = named.find(node.mesh);
        if (skin && joints == named.end())
            context.warn(fmt::format("uses skin '{}', but none of its vertices has joint weights", skin->name),
                         fmt::format("node '{}'", node.name));
        if (skin && joints != named.end() && joints->second > skin->joints.size())
            context.warn(
                fmt::format("vertices use joints beyond the {} of skin '{}': they follow the node", skin->joints.size(), skin->name),
                fmt::format("node '{}'", node.name));
    }
}

} // namespace

std::vector<Id<Skin>> assign_skin_ids(const GltfContext& context) {
    std::vector<uint32_t> wanted;
    for (size_t i = 0; i < context.model().skins.size(); ++i) wanted.push_back(requested_id(gltf_item(context.json(), "skins", i)));
    std::vector<Id<Skin>> ids;
    for (const uint32_t id : assign_ids(wanted)) ids.push_back({id});
    return ids;
}

Result<void> import_skins(const GltfContext& context, const GltfIndices& indices, Scene& scene) {
    const std::vector<Id<Node>> nodes = ids_by_index(indices.nodes, context.model().nodes.size());
    for (const auto& [id, index] : indices.skins) {
        const tinygltf::Skin& source = context.model().skins[size_t(index)];
        const std::string where = fmt::format("skins[{}]", index);
        Skin skin;
        skin.name = source.name.empty() ? fmt::format("Skin {}", index) : source.name;
        size_t missing = 0;
        for (const int joint : source.joints) {
            if (joint < 0 || size_t(joint) >= nodes.size())
                return context.error(fmt::format("joint {} does not exist; there are {} nodes", joint, nodes.size()), where);
            skin.joints.push_back(nodes[size_t(joint)]);
            missing += !nodes[size_t(joint)];
        }
        if (missing) context.warn(fmt::format("{} joints are in no scene: they are fixed at the origin", missing), where);
        Result<std::vector<Affine>> matrices = read_inverse_binds(context, source, where);
        if (!matrices) return matrices.error();
        skin.joint_from_mesh = *std::move(matrices);
        scene.skins.insert(id, std::move(skin));
    }
    report_stray_vertices(context, scene);
    return {};
}

} // namespace blush
