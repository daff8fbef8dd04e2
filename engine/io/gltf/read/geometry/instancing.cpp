#include "io/gltf/read/geometry/instancing.h"

#include "io/gltf/read/geometry/accessors.h"
#include "io/gltf/read/object.h"
#include "io/gltf/write/write_payloads.h"
#include "scene/affine.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace blush {
namespace {

constexpr const char* extension_name = "EXT_mesh_gpu_instancing";

struct Attribute {
    const char* name;
    int components;
    std::array<float, 4> otherwise;
};
constexpr Attribute attributes[] = {{"TRANSLATION", 3, {0, 0, 0}}, {"ROTATION", 4, {0, 0, 0, 1}}, {"SCALE", 3, {1, 1, 1}}};

// By attribute; empty if absent.
using Arrays = std::array<FloatArray, std::size(attributes)>;

Result<Arrays> read_arrays(const GltfContext& context, const GltfObject& object) {
    Arrays arrays;
    for (size_t a = 0; a < arrays.size(); ++a) {
        const auto [name, components, otherwise] = attributes[a];
        if (!object.has(name)) continue;
        Result<FloatArray> read =
            read_floats(context, object.integer(name).value_or(-1), components, components, object.where() + "." + name);
        if (!read) return read.error();
        arrays[a] = *std::move(read);
    }
    return arrays;
}

// An accessor without bytes puts all instances at one point and takes no space in the file.
bool has_bytes(const GltfContext& context, const GltfObject& object) {
    return std::ranges::any_of(attributes, [&](const Attribute& a) {
        const int index = object.has(a.name) ? object.integer(a.name).value_or(-1) : -1;
        const auto& accessors = context.model().accessors;
        return index >= 0 && size_t(index) < accessors.size() && accessors[size_t(index)].bufferView >= 0;
    });
}

Affine place(const Arrays& arrays, size_t copy) {
    std::array<std::array<float, 4>, std::size(attributes)> v;
    for (size_t a = 0; a < arrays.size(); ++a) {
        v[a] = attributes[a].otherwise;
        const auto n = size_t(attributes[a].components);
        if (arrays[a].components) std::copy_n(arrays[a].values.begin() + std::ptrdiff_t(copy * n), n, v[a].begin());
    }
    Transform local;
    local.translation = {v[0][0], v[0][1], v[0][2]};
    local.rotation = {v[1][0], v[1][1], v[1][2], v[1][3]};
    local.scale = {v[2][0], v[2][1], v[2][2]};
    return to_float(to_affine(local));
}

void report_other_attributes(const GltfContext& context, const GltfObject& object) {
    for (const auto& [name, accessor] : object.members())
        if (std::ranges::none_of(attributes, [&](const Attribute& a) { return name == a.name; }))
            context.note("ignored: attribute " + name.substr(0, 100) + " of instances: no material reads it", object.where());
}

} // namespace

Result<InstancesPtr> import_instances(const GltfContext& context, const tinygltf::Node& node, const std::string& where) {
    const GltfObject extension = GltfObject(context, node.extensions, where + ".extensions").object(extension_name);
    if (!extension || context.known) return InstancesPtr();
    if (node.mesh < 0) {
        context.warn("ignored: instances on a node without a mesh", extension.where());
        return InstancesPtr();
    }
    const GltfObject object = extension.object("attributes");
    report_other_attributes(context, object);
    if (!has_bytes(context, object)) {
        context.warn("no instance transforms: the mesh is shown once", extension.where());
        return InstancesPtr();
    }
    const Result<Arrays> arrays = read_arrays(context, object);
    if (!arrays) return arrays.error();
    size_t count = 0;
    for (const FloatArray& array : *arrays) count = std::max(count, array.count());
    for (const FloatArray& array : *arrays)
        if (array.components && array.count() != count)
            return context.error(fmt::format("attributes of {} and of {} copies", count, array.count()), object.where());

    auto instances = std::make_shared<Instances>();
    instances->node_from_copy.reserve(count);
    for (size_t copy = 0; copy < count; ++copy)
        if (const Affine here = place(*arrays, copy); is_finite(to_double(here))) instances->node_from_copy.push_back(here);
    if (const size_t lost = count - instances->node_from_copy.size(); lost > 0)
        context.warn(fmt::format("{} instances with non-finite transforms skipped", lost), extension.where());
    return InstancesPtr(std::move(instances));
}

void write_instances(GltfDocument& document, Json& object, const InstancesPtr& had, const InstancesPtr& now) {
    if (had == now) return;
    erase_extension(object, extension_name);
    if (!now) return;
    std::array<std::vector<float>, std::size(attributes)> values;
    for (const Affine& here : now->node_from_copy) {
        const Transform t = to_transform(to_double(here));
        values[0].insert(values[0].end(), {t.translation.x, t.translation.y, t.translation.z});
        values[1].insert(values[1].end(), {t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w});
        values[2].insert(values[2].end(), {t.scale.x, t.scale.y, t.scale.z});
    }
    Json written = Json::object();
    for (size_t a = 0; a < values.size(); ++a)
        written[attributes[a].name] =
            append_floats(document, values[a].data(), now->node_from_copy.size(), attributes[a].components, false);
    extension_of(object, extension_name)["attributes"] = std::move(written);
}

} // namespace blush
