#include "io/gltf/read/cameras.h"

#include "io/gltf/read/extras.h"
#include "io/gltf/read/ids.h"
#include "io/gltf/read/object.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace blush {
namespace {

constexpr float min_length = 1e-6f; // metres

Lens read_lens(const GltfContext& context, const tinygltf::Camera& source, const std::string& where) {
    Lens lens;
    lens.orthographic = source.type == "orthographic";
    if (lens.orthographic) {
        // A negative magnification mirrors the image; the specification discourages it.
        if (source.orthographic.ymag < 0) context.warn("negative magnification: the absolute value is used", where + ".orthographic.ymag");
        lens.ymag = checked(context, std::abs(source.orthographic.ymag), 1, min_length, any_float, where + ".orthographic.ymag");
    } else {
        constexpr float min_yfov = 1e-4f, max_yfov = std::numbers::pi_v<float> - 1e-4f;
        lens.yfov_radians = checked(context, source.perspective.yfov, lens.yfov_radians, min_yfov, max_yfov, where + ".perspective.yfov");
    }
    const GltfObject blush = GltfObject(context, source.extras, where + ".extras").object("blush");
    lens.aperture_radius = blush.number("aperture_radius", 0, 0, any_float);
    lens.focus_distance = blush.number("focus_distance", 1, min_length, any_float);
    return lens;
}

// From the right and slightly above, so that three sides of a box are visible.
Quat three_quarter_rotation() {
    constexpr double yaw = 35 * std::numbers::pi / 180, pitch = -20 * std::numbers::pi / 180;
    const double cy = std::cos(yaw / 2), sy = std::sin(yaw / 2), cp = std::cos(pitch / 2), sp = std::sin(pitch / 2);
    return {float(cy * sp), float(sy * cp), float(-sy * sp), float(cy * cp)}; // about Y after about X
}

} // namespace

std::vector<Id<Camera>> import_cameras(const GltfContext& context, Scene& scene) {
    std::vector<std::optional<Camera>> cameras;
    std::vector<uint32_t> wanted;
    for (size_t i = 0; i < context.model().cameras.size(); ++i) {
        const tinygltf::Camera& source = context.model().cameras[i];
        const std::string where = fmt::format("cameras[{}]", i);
        Camera camera{source.name.empty() ? fmt::format("Camera {}", i) : source.name, read_lens(context, source, where)};
        const ParsedGltf& object = gltf_item(context.json(), "cameras", i);
        read_extras(context, object, camera, where);
        cameras.push_back(std::move(camera));
        wanted.push_back(requested_id(object));
    }
    const std::vector<Id<Camera>> ids = add_with_ids(scene.cameras, std::move(cameras), wanted);
    if (!ids.empty())
        context.note("ignored: clipping planes of cameras; their aspect ratio is only a frame in the window, the image size sets "
                     "the rendered aspect",
                     "cameras");
    return ids;
}

View initial_view(const Scene& scene) {
    const auto camera_node =
        std::find_if(scene.nodes.begin(), scene.nodes.end(), [](const auto& entry) { return bool(entry.value.camera); });
    if (camera_node != scene.nodes.end()) return view_through(scene, camera_node->id);
    constexpr float aspect = 16.0f / 9;
    View view;
    view.rotation = three_quarter_rotation();
    return framed(view, world_bounds(scene), aspect);
}

bool import_view(const GltfContext& context, const ParsedGltf& gltf_scene, const std::string& scene_where, View& view) {
    const std::string where = scene_where + ".extras.blush.view";
    const Json fields = blush_fields(context, gltf_scene, "view", where);
    if (fields.is_null()) return false;
    View candidate = view;
    read_extra_fields(context, fields, candidate, where);
    if (const auto valid = validate(candidate.lens); !valid) {
        context.warn("ignored: " + valid.error().what, where);
        return false;
    }
    view = candidate;
    return true;
}

} // namespace blush
