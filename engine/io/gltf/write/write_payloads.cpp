#include "io/gltf/write/write_payloads.h"

#include "io/gltf/read/variants.h"
#include "io/image/image_io.h"
#include "scene/geometry/tangents.h"
#include "scene/texture_slots.h"

#include <fmt/format.h>

#include <algorithm>

namespace blush {
namespace {

constexpr int array_buffer = 34962, element_array_buffer = 34963;
constexpr int float_component = 5126, uint_component = 5125, ushort_component = 5123;

std::span<const uint8_t> bytes_of(const void* data, size_t size) { return {static_cast<const uint8_t*>(data), size}; }

template <class Vectors> int append_vectors(GltfDocument& document, const Vectors& vectors, bool with_bounds = false) {
    using V = Vectors::value_type;
    static_assert(sizeof(V) % sizeof(float) == 0);
    constexpr int components = int(sizeof(V) / sizeof(float));
    return append_floats(document, reinterpret_cast<const float*>(vectors.data()), vectors.size(), components, with_bounds);
}

void append_influences(GltfDocument& document, const Geometry& g, Json& attributes) {
    const size_t vertices = g.positions.size(), per_vertex = g.influences.size() / std::max<size_t>(vertices, 1);
    for (size_t set = 0; 4 * set < per_vertex; ++set) {
        std::vector<uint16_t> joints;
        std::vector<Vec4> weights;
        for (size_t i = 0; i < vertices; ++i) {
            const Influence* by = g.influences.data() + i * per_vertex + 4 * set;
            weights.push_back({by[0].weight, by[1].weight, by[2].weight, by[3].weight});
            for (size_t k = 0; k < 4; ++k) joints.push_back(by[k].joint);
        }
        const int view = document.append_view(bytes_of(joints.data(), joints.size() * sizeof(uint16_t)), array_buffer);
        attributes[fmt::format("JOINTS_{}", set)] = document.append(
            "accessors", {{"bufferView", view}, {"componentType", ushort_component}, {"count", vertices}, {"type", "VEC4"}});
        attributes[fmt::format("WEIGHTS_{}", set)] = append_vectors(document, weights);
    }
}

Json primitive_of(GltfDocument& document, const Geometry& g) {
    Json attributes{{"POSITION", append_vectors(document, g.positions, true)}};
    const auto add = [&](const std::string& name, const auto& vectors) {
        if (!vectors.empty()) attributes[name] = append_vectors(document, vectors);
    };
    // Face normals of deformed meshes are not written: they are recomputed after deformation.
    if (const bool deforms = !g.targets.empty() || !g.influences.empty(); !(g.flat && deforms)) {
        add("NORMAL", g.normals);
        add("TANGENT", g.tangents);
    }
    for (size_t set = 0; set < g.uv.size(); ++set) add(fmt::format("TEXCOORD_{}", set), g.uv[set]);
    add("COLOR_0", g.colors);
    append_influences(document, g, attributes);
    Json primitive{{"attributes", std::move(attributes)}, {"indices", append_indices(document, g.indices)}};
    for (const MorphTargetPtr& target : g.targets) {
        Json offsets = Json::object();
        if (!target->positions.empty()) offsets["POSITION"] = append_vectors(document, target->positions, true);
        if (!target->normals.empty()) offsets["NORMAL"] = append_vectors(document, target->normals);
        if (!target->tangents.empty()) offsets["TANGENT"] = append_vectors(document, target->tangents);
        primitive["targets"].push_back(std::move(offsets));
    }
    return primitive;
}

// Parts with the same geometry share accessors.
using Primitives = std::map<uint64_t, Json>; // by the geometry's serial

void append_mesh(GltfDocument& document, Id<Mesh> id, const Mesh& mesh, Primitives& primitives) {
    Json object{{"primitives", Json::array()}};
    std::vector<int>& parts = document.indices.primitives[id];
    parts.clear();
    for (const MeshPart& part : mesh.parts) {
        const auto [primitive, is_new] = primitives.try_emplace(part.geometry->serial);
        // Without generated tangents: they are generated again on import.
        if (is_new) primitive->second = primitive_of(document, *without_generated_tangents(part.geometry));
        parts.push_back(int(object["primitives"].size()));
        object["primitives"].push_back(primitive->second);
    }
    if (!mesh.target_names.empty()) object["extras"]["targetNames"] = mesh.target_names;
    document.indices.meshes[id] = document.append("meshes", std::move(object));
}

bool has_triangles(const GltfDocument& document, const GltfOrigin& has, Id<Mesh> id, const Mesh& mesh) {
    const Mesh* old = has.meshes.find(id);
    return document.indices.meshes.contains(id) && old &&
           std::ranges::equal(old->parts, mesh.parts, {}, &MeshPart::geometry, &MeshPart::geometry);
}

Result<int> append_image(GltfDocument& document, const Image& image) {
    const Result<std::vector<uint8_t>> png = encode_png(image);
    if (!png) return png.error();
    return document.append("images", {{"bufferView", document.append_view(*png, 0)}, {"mimeType", "image/png"}});
}

Result<void> write_textures(GltfDocument& document, const GltfOrigin& has, const Scene& scene, const UsedRecords& used) {
    std::map<uint64_t, int> images; // by the image's serial
    for (const Id<Texture> id : used.textures) {
        const Texture& texture = *scene.textures.find(id);
        const Texture* old = has.textures.find(id);
        const bool known = document.indices.textures.contains(id);
        if (!texture.image || (known && old && old->image == texture.image)) continue;
        const auto [image, is_new] = images.try_emplace(texture.image->serial);
        if (is_new) {
            const Result<int> appended = append_image(document, *texture.image);
            if (!appended) return appended.error();
            image->second = *appended;
        }
        if (!known) document.indices.textures[id] = document.append("textures", Json::object());
        Json& object = document.object("textures", document.indices.textures.at(id));
        set_index(object, "source", image->second);
        erase(object, "extensions"); // they refer to the old pixels in other formats
    }
    return {};
}

// Number of UV sets that the material needs: glTF does not allow gaps.
int uv_sets_of(const Scene& scene, Id<Material> id) {
    const Material* material = scene.materials.find(id);
    return material && !uv_sets_read(*material).empty() ? *uv_sets_read(*material).rbegin() + 1 : 0;
}

// glTF requires texture coordinates for textures: missing ones are written as zeros and marked as a fallback, so that they are
// not imported.
void provide_uv_sets(GltfDocument& document, Json& primitive, int sets) {
    for (int set = 0; set <= max_uv_set; ++set) {
        const std::string name = fmt::format("TEXCOORD_{}", set);
        Json& attributes = primitive["attributes"];
        int there = -1;
        const bool fallback =
            read_json(child_or_null(attributes, name), there) &&
            child_or_null(child_or_null(child_or_null(document.object("accessors", there), "extras"), "blush"), "fallback") == true;
        if (fallback && set >= sets) erase(attributes, name);
        if (there < 0 && set >= sets) break;
        if (there >= 0 || set >= sets) continue;
        const Json count = child_or_null(document.object("accessors", attributes.at("POSITION").get<int>()), "count");
        attributes[name] = document.append(
            "accessors",
            {{"componentType", float_component}, {"count", count}, {"type", "VEC2"}, {"extras", {{"blush", {{"fallback", true}}}}}});
    }
}

// Index 0 is the default material.
std::vector<Id<Material>> materials_of(const MeshPart& part) {
    return part.by_variant.empty() ? std::vector{part.material} : part.by_variant;
}

} // namespace

UsedRecords used_records(const Scene& scene) {
    UsedRecords used;
    for (const auto& [id, node] : scene.nodes) {
        if (scene.meshes.contains(node.mesh)) used.meshes.insert(node.mesh);
        if (scene.lights.contains(node.light)) used.lights.insert(node.light);
        if (scene.cameras.contains(node.camera)) used.cameras.insert(node.camera);
    }
    for (const Id<Mesh> id : used.meshes)
        for (const MeshPart& part : scene.meshes.find(id)->parts)
            for (const Id<Material> material : materials_of(part))
                if (scene.materials.contains(material)) used.materials.insert(material);
    for (const Id<Material> id : used.materials)
        for (const TextureSlot& slot : texture_slots)
            if (const Id<Texture> texture = (scene.materials.find(id)->*slot.ref).texture; scene.textures.contains(texture))
                used.textures.insert(texture);
    return used;
}

Result<void> write_payloads(GltfDocument& document, const GltfOrigin& has, const Scene& scene, const UsedRecords& used) {
    if (const auto ok = write_textures(document, has, scene, used); !ok) return ok;
    for (const Id<Material> id : used.materials)
        if (!document.indices.materials.contains(id)) document.indices.materials[id] = document.append("materials", Json::object());
    Primitives primitives;
    for (const Id<Mesh> id : used.meshes) {
        const Mesh& mesh = *scene.meshes.find(id);
        if (mesh.parts.empty() && !document.indices.meshes.contains(id)) continue; // glTF does not allow meshes without primitives
        if (!has_triangles(document, has, id, mesh)) append_mesh(document, id, mesh, primitives);
        Json& object = document.object("meshes", document.indices.meshes.at(id));
        for (size_t part = 0; part < mesh.parts.size(); ++part) {
            const auto material = document.indices.materials.find(materials_of(mesh.parts[part]).front());
            Json& primitive = object["primitives"][size_t(document.indices.primitives.at(id)[part])];
            set_index(primitive, "material", material == document.indices.materials.end() ? -1 : material->second);
            write_variants(primitive, mesh.parts[part], document.indices.materials);
            int uv_sets = 0;
            for (const Id<Material> assigned : materials_of(mesh.parts[part])) uv_sets = std::max(uv_sets, uv_sets_of(scene, assigned));
            provide_uv_sets(document, primitive, uv_sets);
        }
    }
    return {};
}

int append_floats(GltfDocument& document, const float* values, size_t count, int components, bool with_bounds) {
    constexpr const char* types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    const char* type = components == 16 ? "MAT4" : types[components];
    const size_t size = size_t(components);
    Json accessor{{"bufferView", document.append_view(bytes_of(values, count * size * sizeof(float)), array_buffer)},
                  {"componentType", float_component},
                  {"count", count},
                  {"type", type}};
    for (size_t c = 0; c < size && with_bounds && count > 0; ++c) {
        float low = values[c], high = values[c];
        for (size_t i = 1; i < count; ++i) {
            low = std::min(low, values[i * size + c]);
            high = std::max(high, values[i * size + c]);
        }
        accessor["min"].push_back(low);
        accessor["max"].push_back(high);
    }
    return document.append("accessors", std::move(accessor));
}

int append_indices(GltfDocument& document, std::span<const uint32_t> indices) {
    const int view = document.append_view(bytes_of(indices.data(), indices.size() * sizeof(uint32_t)), element_array_buffer);
    return document.append("accessors",
                           {{"bufferView", view}, {"componentType", uint_component}, {"count", indices.size()}, {"type", "SCALAR"}});
}

} // namespace blush
