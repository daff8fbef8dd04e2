// Camera: how the view sees. Navigating it bypasses the history; its lens does not.
#include "scene/pose.h"
#include "ui/panels/panels.h"
#include "ui/rotation.h"
#include "ui/widgets.h"

#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

constexpr float full_frame_height = 0.024f; // metres, of 36 x 24 mm film

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
    if (!f.choice("Look through", name, names, "Put the view where one of the scene's cameras is, with its lens.")) return;
    const auto at = size_t(std::ranges::find(names, name) - names.begin());
    if (nodes[at] && c.apply(LookThrough{nodes[at]})) c.ui.home.camera = nodes[at];
}

void draw_projection(Fields& f, Lens& lens) {
    static constexpr const char* projections[] = {"Perspective", "Orthographic"};
    int projection = lens.orthographic;
    if (f.choice("Projection", projection, projections,
                 "Orthographic views keep parallel lines parallel and show every distance at the same size."))
        lens.orthographic = projection == 1;
    if (lens.orthographic) {
        float height = 2 * lens.ymag;
        if (f.number("Height", height, {.min = 1e-4f, .max = 1e6f, .reset = 2, .unit = "m", .tip = "How many metres the picture is high."}))
            lens.ymag = height / 2;
        return;
    }
    f.angle("Field of view", lens.yfov_radians,
            {.min = 1, .max = 170, .reset = 39.6f, .bar = true, .tip = "Vertical angle of the picture."});
    const float focal = full_frame_height / 2 / std::tan(lens.yfov_radians / 2);
    f.info("", fmt::format("{:.0f} mm on full frame", focal * 1000), "The lens that gives this angle on film of 36 x 24 mm.");
}

void draw_focus(Fields& f, Lens& lens) {
    float millimetres = lens.aperture_radius * 1000;
    if (f.number("Aperture", millimetres,
                 {.min = 0,
                  .max = 1e6f,
                  .reset = 0,
                  .unit = "mm",
                  .step = 0.05f,
                  .tip = "Radius of the lens opening. 0 is a pinhole, sharp everywhere; wider blurs what is not in focus."}))
        lens.aperture_radius = millimetres / 1000;
    if (lens.aperture_radius > 0 && !lens.orthographic) {
        const float focal = full_frame_height / 2 / std::tan(lens.yfov_radians / 2);
        f.info("", fmt::format("f/{:.2g} on full frame", focal / (2 * lens.aperture_radius)));
    }
    f.number("Focus", lens.focus_distance,
             {.min = 1e-3f,
              .max = 1e6f,
              .reset = 1,
              .unit = "m",
              .tip = "Distance along the view axis to what is sharp. Ctrl+click in the picture sets it."});
}

void draw_pose(PanelContext& c) {
    View view = c.scene().view;
    Fields f(c.ui, "View");
    f.vector("Position", view.position, view.position,
             {.step = 0.01f, .tip = "Of the eye, in metres. Moving the view is not a step of the history."});
    f.number("Pivot", view.pivot_distance,
             {.min = 1e-3f,
              .max = 1e6f,
              .reset = view.pivot_distance,
              .unit = "m",
              .tip = "How far before the eye the point lies that orbiting turns about. F puts it on the selection."});
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
    if (f.button("Look through", "Put the view where this camera is, with its lens.")) c.apply(LookThrough{id});
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
                  .tip = "Each EV doubles the brightness of the picture as shown. The render is not touched.",
                  .format = "%+.2f"});
        if (f.changed()) c.apply(SetView{settings}, f.gesture());
    }
}

} // namespace blush
