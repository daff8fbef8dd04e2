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
#include "ui/window/imgui_state.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
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

// The surface under the mouse, if it is over an object in the image; else the subject's centre.
LightPlacement placement_of_new_light(PanelContext& c) {
    const View& view = c.scene().view;
    if (const auto& cursor = c.ui.cursor; cursor && c.frame && c.frame->width > 0) {
        const Projection projection(view, double(c.frame->width) / c.frame->height);
        if (const auto surface = surface_at_pixel(*c.frame, projection, cursor->u, cursor->v))
            return placement_above_surface(c.scene(), view, *surface);
    }
    const Bounds selected = bounds_of_meshes(c.scene(), c.ui.selection(c.scene()));
    return placement_around_subject(c.scene(), view, selected.empty ? world_bounds(c.scene()) : selected);
}

void add_light(PanelContext& c, Light::Kind kind) {
    const Id<Node> last = last_node(c.scene());
    if (c.apply(new_light(kind, c.scene().view, placement_of_new_light(c), c.shown_view().exposure_ev))) select_all_after(c, last);
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
                         keys_of(shortcut(Command::snapshot_exr)) + " takes a snapshot of the current image.");
}

void toggle_denoise(PanelContext& c) {
    if (c.denoiser_problem.empty()) return c.ui.denoise.toggle();
    c.ui.toasts.warn("The image cannot be denoised", c.denoiser_problem);
}

// Closes or cancels the topmost item: a menu, the shortcut sheet, a tool, the presentation, placing, the light camera, the selection.
void escape(PanelContext& c) {
    if (close_top_popup()) return;
    for (bool* open : {&c.ui.show_shortcuts, &c.ui.opening_page})
        if (std::exchange(*open, false)) return;
    if (c.ui.tool != ViewTool::none) {
        c.ui.tool = ViewTool::none;
        return c.ui.tool_start.reset();
    }
    if (c.ui.presentation.on) {
        c.ui.presentation.wanted = false;
        return;
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

void toggle_meters(PanelContext& c) {
    toggle_instrument(c, "meters");
    if (c.ui.meters.open && c.project().view.meters.empty()) c.ui.tool = ViewTool::meter;
}

void toggle_paths(PanelContext& c) {
    toggle_instrument(c, "paths");
    if (c.ui.paths.open && !c.ui.paths.request) c.ui.tool = ViewTool::paths;
}

void toggle_bleed(PanelContext& c) {
    toggle_instrument(c, "bleed");
    if (c.ui.bleed.open && !c.ui.bleed.has_place()) c.ui.tool = ViewTool::bleed;
}

void snapshots_beside_scene(PanelContext& c) {
    c.ui.settings.snapshot_folder.clear();
    c.ui.toasts.note("Snapshots go beside the scene again");
}

struct CommandAction {
    Command command;
    void (*run)(PanelContext&);
};
constexpr CommandAction command_actions[] = {
    {Command::undo, [](PanelContext& c) { c.document.undo(); }},
    {Command::redo, [](PanelContext& c) { c.document.redo(); }},
    {Command::copy_value, [](PanelContext& c) { request_value_action(c.ui, ValueAction::copy); }},
    {Command::paste_value, [](PanelContext& c) { request_value_action(c.ui, ValueAction::paste); }},
    {Command::snapshots_beside_scene, snapshots_beside_scene},
    {Command::reset_value, [](PanelContext& c) { request_value_action(c.ui, ValueAction::reset); }},
    {Command::duplicate, duplicate},
    {Command::remove, remove},
    {Command::add_ground, [](PanelContext& c) { add_ground(c, false); }},
    {Command::add_catcher, [](PanelContext& c) { add_ground(c, true); }},
    {Command::rename, begin_rename},
    {Command::clear_selection, escape},
    {Command::add_point, [](PanelContext& c) { add_light(c, Light::Kind::point); }},
    {Command::add_spot, [](PanelContext& c) { add_light(c, Light::Kind::spot); }},
    {Command::add_sun, [](PanelContext& c) { add_light(c, Light::Kind::sun); }},
    {Command::add_rectangle, [](PanelContext& c) { add_light(c, Light::Kind::rectangle); }},
    {Command::add_disk, [](PanelContext& c) { add_light(c, Light::Kind::disk); }},
    {Command::add_sphere, [](PanelContext& c) { add_light(c, Light::Kind::sphere); }},
    {Command::light_by_studio, [](PanelContext& c) { add_light_rig(c, LightRig::studio); }},
    {Command::light_by_sky, [](PanelContext& c) { add_light_rig(c, LightRig::sky); }},
    {Command::mute, toggle_mute},
    {Command::solo, toggle_solo},
    {Command::group_lights, group_lights},
    {Command::place_highlight, [](PanelContext& c) { toggle_placing(c, PlacingBy::highlight); }},
    {Command::place_shadow, [](PanelContext& c) { toggle_placing(c, PlacingBy::shadow); }},
    {Command::look_through_light, toggle_look_through},
    {Command::light_table, [](PanelContext& c) { toggle_instrument(c, "light_table"); }},
    {Command::grab, [](PanelContext& c) { c.ui.transform.begin(Command::grab); }},
    {Command::rotate, [](PanelContext& c) { c.ui.transform.begin(Command::rotate); }},
    {Command::scale, [](PanelContext& c) { c.ui.transform.begin(Command::scale); }},
    {Command::next_gizmo, [](PanelContext& c) { c.ui.transform.gizmo = TransformMode((int(c.ui.transform.gizmo) + 1) % 3); }},
    {Command::local_axes, [](PanelContext& c) { c.ui.transform.local = !c.ui.transform.local; }},
    {Command::frame_selection, [](PanelContext& c) { frame(c, bounds_of_selection(c)); }},
    {Command::frame_all, [](PanelContext& c) { frame(c, world_bounds(c.scene())); }},
    {Command::camera_view, go_home},
    {Command::toggle_projection, toggle_projection},
    {Command::toggle_overlays, [](PanelContext& c) { c.ui.settings.overlays = !c.ui.settings.overlays; }},
    {Command::toggle_panels, [](PanelContext& c) { c.ui.panels_hidden = !c.ui.panels_hidden; }},
    {Command::presentation, [](PanelContext& c) { c.ui.presentation.wanted = !c.ui.presentation.wanted; }},
    {Command::toggle_zoom, [](PanelContext& c) { c.ui.zoom = toggled(c.ui.zoom); }},
    {Command::exposure_up, [](PanelContext& c) { change_exposure(c, c.project().view.exposure_ev + 0.5f); }},
    {Command::exposure_down, [](PanelContext& c) { change_exposure(c, c.project().view.exposure_ev - 0.5f); }},
    {Command::exposure_reset, [](PanelContext& c) { change_exposure(c, 0); }},
    {Command::exposure_meter, meter_once},
    {Command::exposure_auto, toggle_auto_exposure},
    {Command::reset_white, reset_white},
    {Command::pick_white, [](PanelContext& c) { c.ui.tool = ViewTool::pick_white; }},
    {Command::toggle_denoise, toggle_denoise},
    {Command::pause, [](PanelContext& c) { c.ui.paused = !c.ui.paused; }},
    {Command::snapshot_strip, [](PanelContext& c) { c.ui.snapshots.open = !c.ui.snapshots.open; }},
    {Command::dock_all, [](PanelContext& c) { dock_all(c.ui.settings.dock); }},
    {Command::undelete_snapshot, [](PanelContext& c) { c.ui.snapshots.put_back(); }},
    {Command::compare_wipe, [](PanelContext& c) { compare(c, Comparison::Mode::wipe); }},
    {Command::compare_flicker, [](PanelContext& c) { compare(c, Comparison::Mode::flicker); }},
    {Command::compare_difference, [](PanelContext& c) { compare(c, Comparison::Mode::difference); }},
    {Command::guide, [](PanelContext& c) { c.ui.guide_page = "README.html"; }},
    {Command::shortcuts, [](PanelContext& c) { c.ui.show_shortcuts = !c.ui.show_shortcuts; }},
    {Command::history, [](PanelContext& c) { toggle_instrument(c, "history"); }},
    {Command::light_mix, toggle_light_mix},
    {Command::bounces, [](PanelContext& c) { toggle_instrument(c, "bounces"); }},
    {Command::import_report, [](PanelContext& c) { toggle_instrument(c, "import_report"); }},
    {Command::farm, [](PanelContext& c) { toggle_instrument(c, "farm"); }},
    {Command::health, [](PanelContext& c) { toggle_instrument(c, "health"); }},
    {Command::next_aov, [](PanelContext& c) { show_aov(c, stepped(c.ui.aov, c.frame.get(), 1)); }},
    {Command::previous_aov, [](PanelContext& c) { show_aov(c, stepped(c.ui.aov, c.frame.get(), -1)); }},
    {Command::render_region, [](PanelContext& c) { c.ui.tool = ViewTool::region; }},
    {Command::render_all, [](PanelContext& c) { render_region(c, {}); }},
    {Command::measure, [](PanelContext& c) { c.ui.tool = ViewTool::measure; }},
    {Command::meters, toggle_meters},
    {Command::paths, toggle_paths},
    {Command::bleed, toggle_bleed},
    {Command::scopes, [](PanelContext& c) { toggle_instrument(c, "scopes"); }},
    {Command::roulette, [](PanelContext& c) { toggle_instrument(c, "roulette"); }},
    {Command::strategies, [](PanelContext& c) { toggle_instrument(c, "strategies"); }},
    {Command::integrators, [](PanelContext& c) { toggle_instrument(c, "integrators"); }},
    {Command::samplers, [](PanelContext& c) { toggle_instrument(c, "samplers"); }},
    {Command::convergence, [](PanelContext& c) { toggle_instrument(c, "convergence"); }},
};

// Those that the editor executes, because they need files or the window.
constexpr Command commands_of_editor[] = {
    Command::open,         Command::import_scene, Command::environment,     Command::ies,
    Command::map,          Command::reload,       Command::save_scene,      Command::save_scene_as,
    Command::snapshot_exr, Command::snapshot_png, Command::snapshot_folder, Command::load_convergence,
    Command::full_screen,  Command::quit,         Command::farm_looks,
};

constexpr bool is_each_command_executed_once() {
    for (int i = 0; i <= int(last_command); ++i) {
        const auto executed = std::ranges::count(command_actions, Command(i), &CommandAction::command);
        if (executed + std::ranges::count(commands_of_editor, Command(i)) != 1) return false;
    }
    return true;
}
static_assert(is_each_command_executed_once(), "a command is in neither or in both of the tables above");

} // namespace

bool run_command(Command command, PanelContext& c) {
    const auto* action = std::ranges::find(command_actions, command, &CommandAction::command);
    if (action == std::end(command_actions)) return false;
    action->run(c);
    return true;
}

} // namespace blush
