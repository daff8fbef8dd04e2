#include "scene/lights/light_rig.h"

#include "core/math.h"
#include "scene/affine.h"
#include "scene/enum_names.h"
#include "scene/geometry/ray_queries.h"
#include "scene/lights/light_visibility.h"
#include "scene/lights/sky_model.h"
#include "scene/world_transforms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

constexpr std::array<EnumName<LightRig>, 3> rig_words{{{LightRig::none, "none"}, {LightRig::studio, "studio"}, {LightRig::sky, "sky"}}};

bool is_bright(const Vec3& color) { return color.x > 0 || color.y > 0 || color.z > 0; }

bool gives_light(const Environment& e) {
    if (!(e.intensity > 0) || (e.kind != Environment::Kind::sky && !is_bright(e.color))) return false;
    if (e.kind != Environment::Kind::image) return true;
    return e.image && (std::ranges::any_of(e.image->floats, [](float v) { return v > 0; }) ||
                       std::ranges::any_of(e.image->bytes, [](uint8_t v) { return v > 0; }));
}

// Which sources of light the visible nodes have.
struct Census {
    bool light = false, lit_surface = false, unlit_surface = false;
};

void count_surfaces(const Scene& scene, const Mesh& mesh, bool some_solo, Census& census) {
    for (const MeshPart& part : mesh.parts) {
        if (!part.geometry || part.geometry->triangle_count() == 0) continue;
        const Material* material = scene.materials.find(part.material);
        (material && material->unlit ? census.unlit_surface : census.lit_surface) = true;
        census.light |= material && emits_light(*material, some_solo);
    }
}

Census census_of(const Scene& scene) {
    Census census;
    const bool some_solo = any_solo(scene);
    census.light = emits_light(scene.environment, some_solo) && gives_light(scene.environment);
    WorldTransforms transforms(scene);
    for (const auto& [id, node] : scene.nodes) {
        const Light* light = node.light ? scene.lights.find(node.light) : nullptr;
        const Mesh* mesh = node.mesh ? scene.meshes.find(node.mesh) : nullptr;
        if ((!light && !mesh) || !transforms(id).visible) continue;
        census.light |= light && emits_light(*light, some_solo) && light->intensity > 0 && is_bright(light->color);
        if (mesh) count_surfaces(scene, *mesh, some_solo, census);
    }
    return census;
}

// Sphere that the rig is placed around.
struct Subject {
    Vec3d center{0, 0, 0};
    double radius = 1;
    bool from_inside = false; // the camera is inside the scene
};

Subject subject_of(const Scene& scene) {
    const Bounds bounds = world_bounds(scene);
    Subject subject;
    if (bounds.empty || !(bounds.radius() > 0) || !std::isfinite(bounds.radius())) return subject;
    subject.center = bounds.center();
    subject.radius = bounds.radius();
    const Vec3d eye = to_double(scene.view.position);
    const Vec3d beyond_low = eye - bounds.low, beyond_high = bounds.high - eye;
    subject.from_inside = std::min({beyond_low.x, beyond_low.y, beyond_low.z, beyond_high.x, beyond_high.y, beyond_high.z}) > 0;
    if (!subject.from_inside) return subject;
    // The view's pivot, in front of the geometry.
    const Vec3d forward = to_affine(scene.view.rotation).z * -1;
    const auto all = [](Id<Node>) { return true; };
    const double reach = std::clamp(double(scene.view.pivot_distance), 0.05 * subject.radius, 2 * subject.radius);
    const double distance = reach * unoccluded_fraction(scene, eye, eye + forward * reach, all);
    subject.center = eye + forward * (0.9 * distance);
    subject.radius = std::max(0.5 * distance, 0.01 * subject.radius);
    return subject;
}

// Axes of the levelled view: right, up, towards the camera.
struct LevelFrame {
    Vec3d right, up{0, 1, 0}, back;
    Vec3d direction(double azimuth_degrees, double elevation_degrees) const {
        const double a = azimuth_degrees * std::numbers::pi / 180, e = elevation_degrees * std::numbers::pi / 180;
        return (right * std::sin(a) + back * std::cos(a)) * std::cos(e) + up * std::sin(e);
    }
};

LevelFrame level_frame(const View& view) {
    const Affined eye = to_affine(view.rotation);
    LevelFrame frame;
    const Vec3d level{eye.z.x, 0, eye.z.z}, beside{eye.x.x, 0, eye.x.z};
    // A view straight up or down keeps its own right axis.
    if (length(level) > 1e-3)
        frame.back = normalize(level);
    else
        frame.back = length(beside) > 1e-3 ? cross(normalize(beside), frame.up) : Vec3d{0, 0, 1};
    frame.right = cross(frame.up, frame.back);
    return frame;
}

struct Softbox {
    const char* name;
    double azimuth_degrees, elevation_degrees; // azimuth from the camera, positive to the right
    double width, height;                      // in radii of the subject
    double lux;                                // at the subject, on a surface that faces it
};
constexpr std::array<Softbox, 3> softboxes{{{"Key softbox", -40, 35, 2.8, 2.8, rig_key_lux},
                                            {"Fill softbox", 50, 12, 3.4, 3.4, rig_fill_lux},
                                            {"Rim softbox", 160, 45, 2.2, 2.2, rig_rim_lux}}};
constexpr double softbox_distance = 3.5; // in radii of the subject

// Illuminance (lux) at `distance` on the axis of a rectangle of 1 nit, on a surface that faces it (Lambert 1760; four quarter
// rectangles).
double lux_of_rectangle(double width, double height, double distance) {
    const double a = 0.5 * width / distance, b = 0.5 * height / distance, p = std::hypot(1, a), q = std::hypot(1, b);
    return 2 * (a / p * std::atan(b / p) + b / q * std::atan(a / q));
}

AddLight softbox_at(const Scene& scene, const Subject& subject, const LevelFrame& frame, const Softbox& box) {
    const Vec3d outward = frame.direction(box.azimuth_degrees, box.elevation_degrees);
    const double wanted = softbox_distance * subject.radius;
    const auto all = [](Id<Node>) { return true; };
    // If the camera is outside, the line of sight starts at the subject's bounding sphere: the subject is no obstacle.
    const double from = subject.from_inside ? 0 : 1.001 * subject.radius;
    const double free = unoccluded_fraction(scene, subject.center + outward * from, subject.center + outward * wanted, all);
    const double distance = free < 1 ? from + 0.9 * free * (wanted - from) : wanted;
    const double shrunk = distance / wanted;
    AddLight add;
    add.node.name = add.light.name = box.name;
    add.node.local.translation = to_float(subject.center + outward * distance);
    const Vec3d right = normalize(cross(frame.up, outward));
    add.node.local.rotation = to_quat({right, cross(outward, right), outward, {0, 0, 0}});
    add.light.kind = Light::Kind::rectangle;
    add.light.width = float(box.width * subject.radius * shrunk);
    add.light.height = float(box.height * subject.radius * shrunk);
    add.light.intensity = float(box.lux / lux_of_rectangle(box.width, box.height, softbox_distance));
    add.light.visible_to_camera = false;
    return add;
}

Environment studio_environment(const Environment& map) {
    Environment e = map;
    if (e.kind != Environment::Kind::image || !e.image) e.kind = Environment::Kind::constant;
    e.color = {1, 1, 1};
    e.intensity = float(rig_environment_lux / std::numbers::pi);
    e.lights_scene = true;
    return e;
}

Environment sky_environment(const Environment& before) {
    Environment e;
    e.kind = Environment::Kind::sky;
    e.sky = before.sky;
    const SkyModel sky(e.sky);
    const double sun = e.sky.sun_disk ? std::max(0.0, sky.sun_direction().y) : 0;
    const double lux = luminance(sky.sky_illuminance() + sky.sun_illuminance() * sun);
    if (lux > 0) e.intensity = float(rig_sky_lux / lux);
    return e;
}

} // namespace

Result<LightRig> parse_light_rig(std::string_view text) { return enum_from_string(rig_words, text, "light"); }
std::string_view to_string(LightRig rig) { return enum_to_string(rig_words, rig); }

bool has_light(const Scene& scene) {
    const Census census = census_of(scene);
    return census.light || (census.unlit_surface && !census.lit_surface);
}

std::vector<Edit> light_rig_edits(const Scene& scene, LightRig rig, const Environment& studio_map) {
    std::vector<Edit> edits;
    if (rig == LightRig::sky) edits.push_back(SetEnvironment{sky_environment(scene.environment)});
    if (rig != LightRig::studio) return edits;
    const Subject subject = subject_of(scene);
    const LevelFrame frame = level_frame(scene.view);
    for (const Softbox& box : softboxes) edits.push_back(softbox_at(scene, subject, frame, box));
    edits.push_back(SetEnvironment{studio_environment(studio_map)});
    return edits;
}

Result<Scene> with_light_rig(const Scene& scene, LightRig rig, const Environment& studio_map) {
    Project project;
    project.scene = scene;
    for (const Edit& edit : light_rig_edits(scene, rig, studio_map)) {
        Result<Project> next = blush::apply(project, edit);
        if (!next) return next.error();
        project = *std::move(next);
    }
    return std::move(project.scene);
}

} // namespace blush
