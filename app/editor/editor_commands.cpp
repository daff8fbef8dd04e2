#include "app/editor/editor_commands.h"

#include "app/editor/light_commands.h"
#include "scene/document/subtree_edits.h"
#include "scene/geometry/ground_plane.h"
#include "ui/lights/multi_edit.h"
#include "ui/lights/new_light.h"
#include "ui/panels/instruments.h"
#include "ui/snapshots/aov_bar.h"
#include "ui/viewport/view_tools.h"
#include "ui/widgets/value_menu.h"
#include "ui/window/docks.h"
#include "ui/window/popups.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

Id<Node> last_node(const Scene& scene) { return scene.nodes.empty() ? Id<Node>{} : scene.nodes.entries().back().id; }

// The meshes of the nodes and their descendants.
Bounds bounds_of_meshes(const Scene& scene, const std::vector<Id<Node>>& roots) {
    Bounds all;
    for (const Id<Node> root : roots)
        for (const Id<Node> id : subtree(scene, root)) {
            const Bounds b = scene.nodes.find(id)->mesh ? world_bounds(scene, id) : Bounds{};
            if (b.empty) continue;
            all.include(b.low);
            all.include(b.high);
        }
    return all;
}

// Selects the nodes that an edit has added, without their descendants.
void select_all_after(PanelContext& c, Id<Node> last) {
    c.ui.select({});
    for (const auto& [id, node] : c.scene().nodes)
        if (id > last && node.parent <= last) c.ui.toggle(id);
}

// The roots of the selection, for edits of whole subtrees.
std::vector<Id<Node>> selected_branches(PanelContext& c) { return subtree_roots(c.scene(), c.ui.selection(c.scene())); }

template <class BranchEdit> bool apply_to_selection(PanelContext& c, const std::string& what) {
    std::vector<Edit> edits;
    for (const Id<Node> id : selected_branches(c)) edits.push_back(BranchEdit{id});
    if (edits.empty()) return false;
    const std::string name = edits.size() == 1 ? label(edits[0], c.project()) : fmt::format("{} {} objects", what, edits.size());
    return c.apply(edits, name);
}

// The surface under the mouse, if it is over an object in the picture; else the subject's centre.
LightSpot spot_for_new_light(PanelContext& c) {
    const View& view = c.scene().view;
    if (const auto& cursor = c.ui.cursor; cursor && c.frame && c.frame->width > 0) {
        const Projection projection(view, double(c.frame->width) / c.frame->height);
        if (const auto surface = surface_at_pixel(*c.frame, projection, cursor->u, cursor->v))
            return spot_over_surface(c.scene(), view, *surface);
    }
    const Bounds selected = bounds_of_meshes(c.scene(), c.ui.selection(c.scene()));
    return spot_round_subject(c.scene(), view, selected.empty ? world_bounds(c.scene()) : selected);
}

void add_light(PanelContext& c, Light::Kind kind) {
    const Id<Node> last = last_node(c.scene());
    if (c.apply(new_light(kind, c.scene().view, spot_for_new_light(c), c.shown_view().exposure_ev))) select_all_after(c, last);
}

void add_ground(PanelContext& c, bool catches_shadows) {
    const Id<Node> last = last_node(c.scene());
    const Edit edit = Import{ground_plane_under(world_bounds(c.scene()), catches_shadows), catches_shadows ? "Shadow catcher" : "Ground"};
    if (c.apply({&edit, 1}, catches_shadows ? "Add shadow catcher" : "Add ground plane")) select_all_after(c, last);
}

void duplicate(PanelContext& c) {
    const Id<Node> last = last_node(c.scene());
    if (apply_to_selection<DuplicateNode>(c, "Duplicate")) select_all_after(c, last);
}

void remove(PanelContext& c) {
    if (apply_to_selection<RemoveNode>(c, "Delete")) c.ui.select({});
}

void begin_rename(PanelContext& c) {
    const Node* node = c.scene().nodes.find(c.ui.selected);
    if (!node) return;
    c.ui.renaming = c.ui.selected;
    c.ui.rename_text = node->name;
    c.ui.scroll_to_selected = true;
}

// Bounds of the meshes of a node and its descendants; without meshes (a light, a camera), a small box around its origin.
Bounds bounds_of(const Scene& scene, Id<Node> root) {
    Bounds all = bounds_of_meshes(scene, {{root}});
    if (!all.empty) return all;
    const Vec3d origin = world_from_node(scene, root).t;
    const Bounds everything = world_bounds(scene);
    const double room = everything.empty ? 0.5 : std::max(everything.radius() * 0.1, 1e-3);
    all.include({origin.x - room, origin.y - room, origin.z - room});
    all.include({origin.x + room, origin.y + room, origin.z + room});
    return all;
}

Bounds bounds_of_selection(PanelContext& c) {
    Bounds all;
    for (const Id<Node> id : c.ui.selection(c.scene())) {
        const Bounds b = bounds_of(c.scene(), id);
        all.include(b.low);
        all.include(b.high);
    }
    return all;
}

void frame(PanelContext& c, const Bounds& bounds) {
    if (bounds.empty) return;
    c.document.navigate(framed(c.scene().view, bounds, float(c.render_width) / float(std::max(c.render_height, 1))));
}

// Back to the camera view, with zoom to fit.
void go_home(PanelContext& c) {
    c.ui.light_camera.reset();
    c.ui.zoom = {};
    const View view = home_view(c.scene(), c.ui.home);
    if (view.lens != c.scene().view.lens && c.scene().nodes.contains(c.ui.home.camera)) c.apply(LookThrough{c.ui.home.camera});
    c.document.navigate(view);
}

// Keeps the size of objects at the pivot.
void toggle_projection(PanelContext& c) {
    const View& view = c.scene().view;
    Lens lens = view.lens;
    lens.orthographic = !lens.orthographic;
    if (lens.orthographic) lens.ymag = float(view.pivot_distance * std::tan(lens.yfov_radians / 2));
    c.apply(SetLens{lens});
}

void change_exposure(PanelContext& c, float exposure_ev) {
    ViewSettings v = c.project().view;
    v.exposure_ev = std::clamp(exposure_ev, -20.f, 20.f);
    c.apply(SetView{v});
}

// Sets the exposure once to that of auto exposure.
void meter_once(PanelContext& c) {
    if (!c.frame) return;
    ViewSettings v = c.project().view;
    v.exposure_ev = metered_exposure(AutoExposure::average, c.frame->rgba, 4);
    v.auto_exposure = AutoExposure::off;
    c.apply(SetView{v});
}

// Switched off, the current exposure is kept.
void toggle_auto_exposure(PanelContext& c) {
    ViewSettings v = c.shown_view();
    if (c.project().view.auto_exposure == AutoExposure::off) {
        v.auto_exposure = AutoExposure::average;
        v.exposure_ev = 0;
    }
    c.apply(SetView{v});
}

void reset_white(PanelContext& c) {
    ViewSettings v = c.project().view;
    v.white = {1, 1, 1};
    c.apply(SetView{v});
}

void compare(PanelContext& c, Comparison::Mode mode) {
    if (!c.ui.snapshots.toggle(mode))
        c.ui.toasts.note("There is no snapshot to compare",
                         keys_of(shortcut(Command::snapshot_exr)) + " takes a snapshot of the current picture.");
}

void toggle_denoise(PanelContext& c) {
    if (c.denoiser_problem.empty()) return c.ui.denoise.toggle();
    c.ui.toasts.warn("The image cannot be denoised", c.denoiser_problem);
}

// Closes or cancels the topmost item: a menu, the shortcut sheet, a tool, placing, the light camera, the selection.
void escape(PanelContext& c) {
    if (close_top_popup()) return;
    for (bool* open : {&c.ui.show_shortcuts, &c.ui.opening_page})
        if (std::exchange(*open, false)) return;
    if (c.ui.tool != ViewTool::none) {
        c.ui.tool = ViewTool::none;
        return c.ui.tool_start.reset();
    }
    if (c.ui.placing_by != PlacingBy::hand) {
        c.ui.placing_by = PlacingBy::hand;
        return;
    }
    if (c.ui.pixel) return c.ui.pixel.reset();
    if (c.ui.light_camera) return toggle_look_through(c);
    if (Comparison& compare = c.ui.snapshots.compare; compare.mode != Comparison::Mode::off) {
        compare.mode = Comparison::Mode::off;
        return;
    }
    c.ui.select({});
}

} // namespace

bool run_command(Command command, PanelContext& c) {
    switch (command) {
    case Command::undo: c.document.undo(); return true;
    case Command::redo: c.document.redo(); return true;
    case Command::copy_value: request_value_action(c.ui, ValueAction::copy); return true;
    case Command::paste_value: request_value_action(c.ui, ValueAction::paste); return true;
    case Command::reset_value: request_value_action(c.ui, ValueAction::reset); return true;
    case Command::duplicate: duplicate(c); return true;
    case Command::remove: remove(c); return true;
    case Command::add_ground: add_ground(c, false); return true;
    case Command::add_catcher: add_ground(c, true); return true;
    case Command::rename: begin_rename(c); return true;
    case Command::clear_selection: escape(c); return true;
    case Command::add_point: add_light(c, Light::Kind::point); return true;
    case Command::add_spot: add_light(c, Light::Kind::spot); return true;
    case Command::add_sun: add_light(c, Light::Kind::sun); return true;
    case Command::add_rectangle: add_light(c, Light::Kind::rectangle); return true;
    case Command::add_disk: add_light(c, Light::Kind::disk); return true;
    case Command::add_sphere: add_light(c, Light::Kind::sphere); return true;
    case Command::light_by_studio: add_light_rig(c, LightRig::studio); return true;
    case Command::light_by_sky: add_light_rig(c, LightRig::sky); return true;
    case Command::mute: toggle_mute(c); return true;
    case Command::solo: toggle_solo(c); return true;
    case Command::group_lights: group_lights(c); return true;
    case Command::place_highlight: toggle_placing(c, PlacingBy::highlight); return true;
    case Command::place_shadow: toggle_placing(c, PlacingBy::shadow); return true;
    case Command::look_through_light: toggle_look_through(c); return true;
    case Command::light_table: toggle_instrument(c, "light_table"); return true;
    case Command::grab:
    case Command::rotate:
    case Command::scale: return c.ui.transform.begin(command);
    case Command::next_gizmo: c.ui.transform.gizmo = TransformMode((int(c.ui.transform.gizmo) + 1) % 3); return true;
    case Command::local_axes: c.ui.transform.local = !c.ui.transform.local; return true;
    case Command::frame_selection: frame(c, bounds_of_selection(c)); return true;
    case Command::frame_all: frame(c, world_bounds(c.scene())); return true;
    case Command::camera_view: go_home(c); return true;
    case Command::toggle_projection: toggle_projection(c); return true;
    case Command::toggle_overlays: c.ui.settings.overlays = !c.ui.settings.overlays; return true;
    case Command::toggle_panels: c.ui.panels_hidden = !c.ui.panels_hidden; return true;
    case Command::toggle_zoom: c.ui.zoom = toggled(c.ui.zoom); return true;
    case Command::exposure_up: change_exposure(c, c.project().view.exposure_ev + 0.5f); return true;
    case Command::exposure_down: change_exposure(c, c.project().view.exposure_ev - 0.5f); return true;
    case Command::exposure_reset: change_exposure(c, 0); return true;
    case Command::exposure_meter: meter_once(c); return true;
    case Command::exposure_auto: toggle_auto_exposure(c); return true;
    case Command::reset_white: reset_white(c); return true;
    case Command::pick_white: c.ui.tool = ViewTool::pick_white; return true;
    case Command::toggle_denoise: toggle_denoise(c); return true;
    case Command::pause: c.ui.paused = !c.ui.paused; return true;
    case Command::snapshot_strip: c.ui.snapshots.open = !c.ui.snapshots.open; return true;
    case Command::dock_all: dock_all(c.ui.settings.dock); return true;
    case Command::undelete_snapshot: c.ui.snapshots.put_back(); return true;
    case Command::compare_wipe: compare(c, Comparison::Mode::wipe); return true;
    case Command::compare_flicker: compare(c, Comparison::Mode::flicker); return true;
    case Command::compare_difference: compare(c, Comparison::Mode::difference); return true;
    case Command::guide: c.ui.guide_page = "README.html"; return true;
    case Command::shortcuts: c.ui.show_shortcuts = !c.ui.show_shortcuts; return true;
    case Command::history: toggle_instrument(c, "history"); return true;
    case Command::light_mix: toggle_light_mix(c); return true;
    case Command::bounces: toggle_instrument(c, "bounces"); return true;
    case Command::import_report: toggle_instrument(c, "import_report"); return true;
    case Command::health: toggle_instrument(c, "health"); return true;
    case Command::next_pass: show_aov(c, stepped(c.ui.aov, c.frame.get(), 1)); return true;
    case Command::previous_pass: show_aov(c, stepped(c.ui.aov, c.frame.get(), -1)); return true;
    case Command::render_region: c.ui.tool = ViewTool::region; return true;
    case Command::render_all: render_region(c, {}); return true;
    case Command::measure: c.ui.tool = ViewTool::measure; return true;
    case Command::meters:
        toggle_instrument(c, "meters");
        if (c.ui.meters.open && c.project().view.meters.empty()) c.ui.tool = ViewTool::meter;
        return true;
    case Command::scopes: toggle_instrument(c, "scopes"); return true;
    case Command::roulette: toggle_instrument(c, "roulette"); return true;
    case Command::convergence: toggle_instrument(c, "convergence"); return true;
    case Command::open:
    case Command::import_scene:
    case Command::environment:
    case Command::ies:
    case Command::map:
    case Command::reload:
    case Command::save_scene:
    case Command::save_scene_as:
    case Command::snapshot_exr:
    case Command::snapshot_png:
    case Command::snapshot_folder:
    case Command::load_convergence:
    case Command::full_screen:
    case Command::quit: return false;
    }
    return false;
}

} // namespace blush
