#include "io/gltf/write/write_fallbacks.h"

#include "io/gltf/write/write.h"
#include "io/gltf/write/write_payloads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

bool is_fallback(const Json& object) { return child_or_null(child_or_null(child_or_null(object, "extras"), "blush"), "fallback") == true; }

const Json marked{{"blush", {{"fallback", true}}}};

// list[index]; nullptr if missing.
Json* find(GltfDocument& document, std::string_view list, const Json& index) {
    Json* const objects = document.find_list(list);
    size_t i = 0;
    return objects && read_json(index, i) && i < objects->size() ? &(*objects)[i] : nullptr;
}

// The only primitive of a fallback; nullptr if another program has changed its structure.
Json* primitive_of(GltfDocument& document, const Json& node) {
    Json* const mesh = is_fallback(node) ? find(document, "meshes", child_or_null(node, "mesh")) : nullptr;
    const auto primitives = mesh ? mesh->find("primitives") : Json::iterator();
    const bool one = mesh && primitives != mesh->end() && primitives->is_array() && primitives->size() == 1;
    return one && find(document, "materials", child_or_null(primitives->front(), "material")) ? &primitives->front() : nullptr;
}

// Number of polygon corners for each kind.
constexpr size_t square = 4, round = 32;
size_t corners_of(const Light& light) { return light.kind == Light::Kind::disk ? round : square; }

// A regular polygon in the plane z = 0, facing -Z: the unit square, or a polygon with the area of the unit disk.
Json polygon(GltfDocument& document, size_t corners) {
    constexpr float pi = std::numbers::pi_v<float>;
    const float step = 2 * pi / float(corners);
    const float radius = corners == square ? std::numbers::sqrt2_v<float> / 2 : std::sqrt(2 * pi / (float(corners) * std::sin(step)));
    std::vector<float> positions, normals;
    std::vector<uint32_t> indices;
    for (size_t i = 0; i < corners; ++i) {
        const float angle = (float(i) + 0.5f) * step;
        positions.insert(positions.end(), {radius * std::cos(angle), radius * std::sin(angle), 0});
        normals.insert(normals.end(), {0, 0, -1});
        if (i >= 2) indices.insert(indices.end(), {0, uint32_t(i), uint32_t(i - 1)});
    }
    Json attributes{{"POSITION", append_floats(document, positions.data(), corners, 3, true)},
                    {"NORMAL", append_floats(document, normals.data(), corners, 3, false)}};
    return {{"attributes", std::move(attributes)}, {"indices", append_indices(document, indices)}};
}

// Finds a polygon with the same number of corners, so that its accessors can be shared.
bool has_corners(GltfDocument& document, const Json& primitive, size_t corners) {
    const Json* positions = find(document, "accessors", child_or_null(child_or_null(primitive, "attributes"), "POSITION"));
    return positions && child_or_null(*positions, "count") == corners;
}

Json shape(GltfDocument& document, size_t corners) {
    for (const Json& node : document.list("nodes")) {
        const Json* there = primitive_of(document, node);
        if (!there || !has_corners(document, *there, corners)) continue;
        Json primitive = *there;
        erase(primitive, "material");
        return primitive;
    }
    return polygon(document, corners);
}

int append_fallback(GltfDocument& document, size_t corners) {
    Json primitive = shape(document, corners);
    primitive["material"] = document.append(
        "materials",
        {{"name", "light"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}}}, {"extras", marked}});
    const int mesh = document.append("meshes", {{"name", "light"}, {"primitives", Json::array({std::move(primitive)})}});
    return document.append("nodes", {{"name", "light"}, {"mesh", mesh}, {"extras", marked}});
}

void write_fallback(GltfDocument& document, int node, const Light& light) {
    Json& object = document.object("nodes", node);
    const bool disk = light.kind == Light::Kind::disk;
    set_vector(object, "scale", {disk ? light.radius : light.width, disk ? light.radius : light.height, 1}, {1, 1, 1});
    Json& material = *find(document, "materials", child_or_null(*primitive_of(document, object), "material"));
    const PlainEmission e = plain_emission(light);
    set_vector(material, "emissiveFactor", {e.color.x, e.color.y, e.color.z}, {0, 0, 0});
    set_number(extension_of(material, "KHR_materials_emissive_strength"), "emissiveStrength", e.intensity, 1);
    set_flag(material, "doubleSided", light.two_sided);
}

bool emits_light(const Light* light) {
    if (!light || list_for(light->kind) != GltfLight::List::area) return false;
    const PlainEmission e = plain_emission(*light);
    return e.intensity > 0 && std::max({e.color.x, e.color.y, e.color.z}) > 0;
}

// The fallback child with that many corners, or -1; removes all other fallbacks from the list.
int take_fallback(GltfDocument& document, Json& node, size_t corners) {
    int found = -1;
    Json left = Json::array();
    const Json before = child_or_null(node, "children");
    for (const Json& child : before) {
        const Json& object = document.object("nodes", child.get<int>());
        if (is_fallback(object)) {
            const Json* primitive = primitive_of(document, object);
            if (found >= 0 || !primitive || !has_corners(document, *primitive, corners)) continue;
            found = child.get<int>();
        }
        left.push_back(child);
    }
    if (left.empty())
        erase(node, "children");
    else if (left != before)
        node["children"] = std::move(left);
    return found;
}

} // namespace

void write_fallbacks(GltfDocument& document, const Scene& scene) {
    for (const auto& [id, node] : scene.nodes) {
        const int index = document.indices.nodes.at(id);
        const auto place = document.indices.lights.find(node.light);
        const bool area = place != document.indices.lights.end() && place->second.list == GltfLight::List::area;
        const Light* light = area ? scene.lights.find(node.light) : nullptr;
        const size_t corners = emits_light(light) ? corners_of(*light) : 0;
        int fallback = take_fallback(document, document.object("nodes", index), corners);
        if (corners == 0) continue;
        if (fallback < 0) {
            fallback = append_fallback(document, corners);
            Json& children = document.object("nodes", index)["children"];
            children.push_back(fallback);
        }
        write_fallback(document, fallback, *light);
    }
}

} // namespace blush
