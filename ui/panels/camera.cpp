// Camera tab: lens, pose and exposure of the view. Navigation is not recorded as undo steps; lens edits are.
#include "color/exposure_meter.h"
#include "scene/animation/pose.h"
#include "ui/panels/panels.h"
#include "ui/transform/rotation.h"
#include "ui/widgets/widgets.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

constexpr float full_frame_height = 0.024f; // metres, of 36 x 24 mm film

float focal_length(const Lens& lens) { return full_frame_height / 2 / std::tan(lens.yfov_radians / 2); } // metres
// 0: a pinhole.
float f_number_of(const Lens& lens) { return lens.aperture_radius > 0 ? focal_length(lens) / (2 * lens.aperture_radius) : 0; }

void draw_scene_cameras(Fields& f, PanelContext& c) {
    std::vector<std::string> names{"Free view"};
    std::vector<Id<Node>> nodes{{}};
    for (const auto& [id, node] : c.scene().nodes) {
        if (!node.camera || !is_in_chosen_scene(c.scene(), id)) continue;
        names.push_back(fmt::format("{}##{}", node.name.empty() ? "Camera" : node.name, id.value));
        nodes.push_back(id);
    }
    const auto current = std::ranges::find(nodes, camera_of_view(c.scene()));
    std::string name = names[size_t(current - nodes.begin())];
    if (!f.choice("Look through", name, names, "Set the view to the pose and lens of one of the scene's cameras.")) return;
    const auto at = size_t(std::ranges::find(names, name) - names.begin());
    if (nodes[at] && c.apply(LookThrough{nodes[at]})) c.ui.home.camera = nodes[at];
}

void draw_projection(Fields& f, Lens& lens) {
    static constexpr const char* projections[] = {"Perspective", "Orthographic"};
    int projection = lens.orthographic;
    if (f.choice("Projection", projection, projections,
                 "Orthographic: parallel lines stay parallel, and size does not depend on distance."))
        lens.orthographic = projection == 1;
    if (lens.orthographic) {
        float height = 2 * lens.ymag;
        if (f.number("Height", height, {.min = 1e-4f, .max = 1e6f, .reset = 2, .unit = "m", .tip = "Height of the view in metres."}))
            lens.ymag = height / 2;
        return;
    }
    f.angle("Field of view", lens.yfov_radians, {.min = 1, .max = 170, .reset = 39.6f, .bar = true, .tip = "Vertical angle of the image."});
    float millimetres = focal_length(lens) * 1000;
    if (f.number("Focal length", millimetres,
                 {.min = 0.14f,
                  .max = 1375,
                  .reset = 33.3f,
                  .unit = "mm",
                  .step = 0.1f,
                  .tip = "Focal length for this field of view on full frame (36 x 24 mm)."}))
        lens.yfov_radians = 2 * std::atan(full_frame_height / 2 * 1000 / millimetres);
}

void draw_focus(Fields& f, Lens& lens) {
    float millimetres = lens.aperture_radius * 1000;
    if (f.number(
            "Aperture", millimetres,
            {.min = 0,
             .max = 1e6f,
             .reset = 0,
             .unit = "mm",
             .step = 0.05f,
             .tip =
                 "Radius of the lens opening. 0 is a pinhole: everything is sharp. A larger radius blurs objects that are out of focus."}))
        lens.aperture_radius = millimetres / 1000;
    if (!lens.orthographic) {
        float f_number = f_number_of(lens);
        if (f.number("f-number", f_number,
                     {.min = 0,
                      .max = 1e6f,
                      .reset = 0,
                      .step = 0.05f,
                      .tip = "Focal length divided by the diameter of the aperture, on full frame. 0 is a pinhole.",
                      .format = f_number > 0 ? "f/%.3g" : "pinhole (%.0f)"}))
            lens.aperture_radius = f_number > 0 ? focal_length(lens) / (2 * f_number) : 0;
    }
    f.number("Focus", lens.focus_distance,
             {.min = 1e-3f,
              .max = 1e6f,
              .reset = 1,
              .unit = "m",
              .tip = "Distance of the focus plane along the view axis. Ctrl+click in the image sets it."});
}

struct AspectPreset {
    const char* name;
    float aspect;
};
constexpr AspectPreset presets[] = {{"Viewport", 0}, {"16:9", 16.f / 9}, {"3:2", 1.5f},     {"4:3", 4.f / 3}, {"1:1", 1},
                                    {"4:5", 0.8f},   {"9:16", 9.f / 16}, {"1.85:1", 1.85f}, {"2.39:1", 2.39f}};

void draw_frame(PanelContext& c) {
    Fields f(c.ui, "Frame");
    CameraFrame& frame = c.ui.frame;
    ViewSettings settings = c.project().view;
    std::vector<std::string> names;
    std::vector<float> aspects;
    const float own = aspect_in_file(frame, c.scene(), c.ui.home.camera);
    if (own > 0) names.push_back(fmt::format("Camera ({:.3g}:1)", own)), aspects.push_back(own);
    for (const AspectPreset& preset : presets) names.push_back(preset.name), aspects.push_back(preset.aspect);
    const auto chosen = std::ranges::find_if(aspects, [&](float a) { return std::abs(a - frame.aspect) < 1e-4f; });
    std::string name = chosen == aspects.end() ? fmt::format("{:.3g}:1", frame.aspect) : names[size_t(chosen - aspects.begin())];
    if (f.choice(
            "Aspect", name, names,
            "Width / height of the camera's frame. In the camera view, the image outside the frame is dimmed. Saved with the scene.")) {
        const auto at = size_t(std::ranges::find(names, name) - names.begin());
        settings.frame_aspect.reset();
        if (own <= 0 || at > 0) settings.frame_aspect = aspects[at]; // index 0 is the camera's own aspect
    }
    ImGui::BeginDisabled(frame.aspect <= 0 || !c.ui.settings.follow_viewport);
    f.checkbox("Fit camera", frame.fit, "Render only the frame, as large as the window allows.");
    ImGui::EndDisabled();
    ImGui::BeginDisabled(!c.scene().nodes.contains(c.ui.home.camera));
    f.checkbox("Lock to view", settings.lock_camera,
               "Lock camera to view: orbiting, panning and flying move the camera itself. Each drag is one undo step.");
    ImGui::EndDisabled();
    if (settings != c.project().view) c.apply(SetView{settings});
}

// Exposure as f-number, shutter time and ISO. If the exposure changes elsewhere, the shutter time is adapted.
void draw_camera_exposure(PanelContext& c, Fields& f, ViewSettings& settings) {
    ExposureTriangle& t = c.ui.triangle;
    const float lens_f_number = f_number_of(c.scene().view.lens);
    float f_number = lens_f_number > 0 ? lens_f_number : t.f_number, iso = t.iso;
    float seconds = std::exp2(settings.exposure_ev - camera_exposure(f_number, 1, iso));
    bool changed = false;
    ImGui::BeginDisabled(lens_f_number > 0);
    changed |= f.number("f-number", f_number,
                        {.min = 0.1f,
                         .max = 1000,
                         .reset = 8,
                         .step = 0.05f,
                         .tip = "With a pinhole it sets only the exposure; otherwise it is the f-number of the lens.",
                         .format = "f/%.3g"});
    ImGui::EndDisabled();
    changed |= f.number("Shutter", seconds,
                        {.min = 1e-9f,
                         .max = 1e9f,
                         .reset = 1 / 125.f,
                         .unit = "s",
                         .step = seconds * 0.005f,
                         .tip = "Exposure time in seconds. Type 1/125 or 0.008.",
                         .fraction = true});
    changed |= f.number("ISO", iso, {.min = 1, .max = 1e7f, .reset = 100, .tip = "Sensitivity of the sensor or film.", .format = "%.0f"});
    if (!changed) return;
    if (lens_f_number <= 0) t.f_number = f_number;
    t.iso = iso;
    settings.exposure_ev = std::clamp(camera_exposure(f_number, seconds, iso), -20.f, 20.f);
}

void draw_pose(PanelContext& c) {
    View view = c.scene().view;
    Fields f(c.ui, "View");
    f.vector("Position", view.position, view.position,
             {.step = 0.01f, .tip = "Position of the view in metres. Moving the view is not an undo step."});
    f.number("Pivot", view.pivot_distance,
             {.min = 1e-3f,
              .max = 1e6f,
              .reset = view.pivot_distance,
              .unit = "m",
              .tip = "Distance from the view to the point that orbiting rotates about. F sets it to the selection."});
    if (f.changed()) c.document.navigate(view);
}

} // namespace

void draw_camera_node_panel(PanelContext& c, Id<Node> id) {
    const Node* node = c.scene().nodes.find(id);
    const Camera* record = node ? c.scene().cameras.find(node->camera) : nullptr;
    if (!record || !section(c.ui, "Camera")) return;
    const Id<Camera> camera_id = node->camera;
    Camera camera = *record;
    Fields f(c.ui, "Scene camera");
    draw_projection(f, camera.lens);
    draw_focus(f, camera.lens);
    if (f.changed()) c.apply(SetCamera{camera_id, camera}, f.gesture());
    if (f.button("Look through", "Set the view to the pose and lens of this camera.")) c.apply(LookThrough{id});
}

void draw_camera_panel(PanelContext& c) {
    Lens lens = c.scene().view.lens;
    {
        Fields f(c.ui, "Camera");
        draw_scene_cameras(f, c);
        draw_projection(f, lens);
        draw_focus(f, lens);
        if (f.changed() && lens != c.scene().view.lens) c.apply(SetLens{lens}, f.gesture());
    }
    if (section(c.ui, "Frame")) draw_frame(c);
    if (section(c.ui, "View")) draw_pose(c);
    if (section(c.ui, "Exposure")) {
        ViewSettings settings = c.project().view;
        Fields f(c.ui, "Exposure");
        f.number("Exposure", settings.exposure_ev,
                 {.min = -20,
                  .max = 20,
                  .reset = 0,
                  .unit = "EV",
                  .step = 0.02f,
                  .tip = "Each EV doubles the displayed brightness. The render does not change.",
                  .format = "%+.2f"});
        if (c.project().view.auto_exposure == AutoExposure::off) draw_camera_exposure(c, f, settings);
        if (f.changed()) c.apply(SetView{settings}, f.gesture());
    }
}

} // namespace blush
