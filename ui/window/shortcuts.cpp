#include "ui/window/shortcuts.h"

#include <algorithm>
#include <cassert>

namespace blush {
namespace {

constexpr KeyPress plain(int key) { return {key, false, false, false}; }
constexpr KeyPress ctrl(int key) { return {key, true, false, false}; }
constexpr KeyPress ctrl_shift(int key) { return {key, true, true, false}; }
constexpr KeyPress ctrl_alt(int key) { return {key, true, false, true}; }
constexpr KeyPress shift(int key) { return {key, false, true, false}; }
constexpr KeyPress in_menu_only{};

constexpr Shortcut table[] = {
    {Command::open, "File", "Open...", ctrl('O')},
    {Command::import_scene, "File", "Import into the scene...", ctrl('I')},
    {Command::environment, "File", "Environment image...", ctrl('E')},
    {Command::ies, "File", "IES file for the light...", in_menu_only},
    {Command::map, "File", "Image for the material...", in_menu_only},
    {Command::reload, "File", "Reload from disk", ctrl('R')},
    {Command::import_report, "File", "Import report", in_menu_only},
    {Command::save_scene, "File", "Save scene", ctrl('S')},
    {Command::save_scene_as, "File", "Save scene as...", ctrl_shift('S')},
    {Command::snapshot_exr, "File", "Take snapshot", plain(key::f1 + 11), ctrl(key::enter)},
    {Command::snapshot_png, "File", "Save snapshot (PNG)", ctrl_alt('S')},
    {Command::snapshot_folder, "File", "Snapshot folder...", in_menu_only},
    {Command::snapshots_beside_scene, "File", "Snapshots beside the scene", in_menu_only},
    {Command::farm, "File", "Render on the farm...", in_menu_only},
    {Command::farm_looks, "File", "Looks for the farm...", in_menu_only},
    {Command::load_convergence, "File", "Load convergence table...", in_menu_only},
    {Command::quit, "File", "Quit", ctrl('Q')},
    {Command::undo, "Edit", "Undo", ctrl('Z')},
    {Command::redo, "Edit", "Redo", ctrl_shift('Z'), ctrl('Y')},
    {Command::copy_value, "Edit", "Copy value", ctrl('C')},
    {Command::paste_value, "Edit", "Paste value", ctrl('V')},
    {Command::reset_value, "Edit", "Reset value", plain(key::backspace)},
    {Command::duplicate, "Edit", "Duplicate", ctrl('D')},
    {Command::remove, "Edit", "Delete", plain(key::remove)},
    {Command::grab, "Edit", "Move", plain('G')},
    {Command::rotate, "Edit", "Rotate", plain('R')},
    {Command::scale, "Edit", "Scale", plain('S')},
    {Command::next_gizmo, "Edit", "Next gizmo", plain('W')},
    {Command::local_axes, "Edit", "Local axes", plain('Q')},
    {Command::add_ground, "Edit", "Add ground plane", in_menu_only},
    {Command::add_catcher, "Edit", "Add shadow catcher", in_menu_only},
    {Command::rename, "Edit", "Rename", plain(key::f1 + 1)},
    {Command::clear_selection, "Edit", "Deselect all", plain(key::escape)},
    {Command::history, "Edit", "History", ctrl('H')},
    {Command::add_point, "Add light", "Point", in_menu_only},
    {Command::add_spot, "Add light", "Spot", in_menu_only},
    {Command::add_sun, "Add light", "Sun", in_menu_only},
    {Command::add_rectangle, "Add light", "Rectangle", shift('A')},
    {Command::add_disk, "Add light", "Disk", in_menu_only},
    {Command::add_sphere, "Add light", "Sphere", in_menu_only},
    {Command::light_by_studio, "Lights", "Studio lighting", in_menu_only},
    {Command::light_by_sky, "Lights", "Sky lighting", in_menu_only},
    {Command::mute, "Lights", "Mute", shift('M')},
    {Command::solo, "Lights", "Solo", plain('O')},
    {Command::group_lights, "Lights", "Group lights", ctrl('G')},
    {Command::place_highlight, "Lights", "Place by highlight", plain('T')},
    {Command::place_shadow, "Lights", "Place by shadow", shift('T')},
    {Command::look_through_light, "Lights", "Look through", plain('L')},
    {Command::light_table, "Lights", "Light table", ctrl('L')},
    {Command::frame_selection, "View", "Frame selection", plain('F')},
    {Command::frame_all, "View", "Frame all", shift('F')},
    {Command::camera_view, "View", "Camera view", plain(key::zero), plain(key::home)},
    {Command::toggle_projection, "View", "Perspective / orthographic", plain('P')},
    {Command::toggle_overlays, "View", "Overlays", plain('H')},
    {Command::toggle_panels, "View", "Hide panels", plain(key::tab)},
    {Command::full_screen, "View", "Full screen", shift(key::f1 + 10)},
    {Command::presentation, "View", "Presentation", plain(key::f1 + 10)},
    {Command::dock_all, "View", "Dock all instruments", in_menu_only},
    {Command::render_region, "View", "Render region", plain('B')},
    {Command::render_all, "View", "Render whole image", shift('B')},
    {Command::pause, "View", "Pause rendering", plain(key::space)},
    {Command::light_mix, "View", "Light mix", ctrl('M')},
    {Command::bounces, "View", "Bounces", in_menu_only},
    {Command::health, "View", "Health", in_menu_only},
    {Command::roulette, "View", "Roulette lab", in_menu_only},
    {Command::strategies, "View", "Strategies", in_menu_only},
    {Command::integrators, "View", "Integrators", in_menu_only},
    {Command::samplers, "View", "Samplers", in_menu_only},
    {Command::convergence, "View", "Convergence", plain('C')},
    {Command::snapshot_strip, "Look", "Snapshots", plain('K')},
    {Command::undelete_snapshot, "Look", "Restore deleted snapshot", in_menu_only},
    {Command::compare_wipe, "Look", "Wipe between A and B", plain('V')},
    {Command::compare_flicker, "Look", "Flicker: A, then B", plain('J')},
    {Command::compare_difference, "Look", "Difference of A and B", shift('V')},
    {Command::toggle_zoom, "Look", "Zoom 1:1", plain('Z')},
    {Command::exposure_up, "Look", "Brighter by 1/2 EV", plain(']')},
    {Command::exposure_down, "Look", "Darker by 1/2 EV", plain('[')},
    {Command::exposure_reset, "Look", "Exposure 0", shift(key::zero)},
    {Command::exposure_meter, "Look", "Meter exposure", plain('X')},
    {Command::exposure_auto, "Look", "Auto exposure", shift('X')},
    {Command::next_aov, "Look", "Next AOV", plain('.')},
    {Command::previous_aov, "Look", "Previous AOV", plain(',')},
    {Command::pick_white, "Look", "Pick white", plain('I')},
    {Command::reset_white, "Look", "Reset white balance", shift('I')},
    {Command::toggle_denoise, "Look", "Raw / denoised", plain('N')},
    {Command::measure, "Look", "Measure a region", plain('M')},
    {Command::meters, "Look", "Light meters", shift('L')},
    {Command::paths, "Look", "Paths of a pixel", shift('P')},
    {Command::bleed, "Look", "Bleed", in_menu_only},
    {Command::scopes, "Look", "Scopes", shift('S')},
    {Command::guide, "Help", "Guide", in_menu_only},
    {Command::shortcuts, "Help", "Shortcuts", plain(key::f1)},
};

constexpr MouseHint hints[] = {
    {"Select", "Click"},
    {"Orbit", "Drag, middle-drag or Alt+drag"},
    {"Pan", "Shift+drag or Shift+middle-drag"},
    {"Dolly", "Wheel or Alt+right-drag"},
    {"Look around and fly", "Right-drag and W A S D Q E, Shift is faster"},
    {"Select several", "Shift+click; Ctrl or Shift+click in lists"},
    {"Turn the environment", "Ctrl+Shift+drag"},
    {"Expose", "E+drag or Alt+wheel"},
    {"Zoom the image", "Ctrl+wheel; Ctrl+drag moves it"},
    {"Focus there", "Ctrl+click"},
    {"Read a pixel's values", "Right-click"},
    {"Move, aim, resize", "Drag the handles of the selection"},
    {"Move, rotate, scale (G R S)", "X Y Z: axis, twice: local, Shift+: plane"},
    {"", "Digits: amount; Shift: finely; Ctrl: snap"},
    {"", "R twice: trackball"},
    {"", "Enter/click: confirm; Esc/right-click: cancel"},
    {"Show a snapshot in a presentation", "1 to 9; the same key again: live image"},
    {"Restore a snapshot", "Click its card; right-click for more"},
    {"Link light and object", "Shift+click the object, light selected"},
    {"Link shadow and object", "Alt+Shift+click the object"},
    {"Type a value", "Double-click or Ctrl+click; Tab: the next"},
    {"Change a value finely", "Shift+drag"},
    {"Copy, paste, reset a value", "Right-click it"},
    {"Menus, lists, dialogs", "Arrow keys, Tab, Enter, Esc"},
};

} // namespace

std::span<const Shortcut> shortcuts() { return table; }

const Shortcut& shortcut(Command command) {
    const auto it = std::ranges::find(table, command, &Shortcut::command);
    assert(it != std::end(table));
    return *it;
}

const Shortcut* find_shortcut(const KeyPress& press) {
    if (press.key == key::none) return nullptr;
    const auto it = std::ranges::find_if(table, [&](const Shortcut& s) { return s.press == press || s.also == press; });
    return it == std::end(table) ? nullptr : &*it;
}

std::string to_string(const KeyPress& press) {
    if (press.key == key::none) return {};
    std::string text;
    if (press.ctrl) text += "Ctrl+";
    if (press.shift) text += "Shift+";
    if (press.alt) text += "Alt+";
    switch (press.key) {
    case key::space: return text + "Space";
    case key::enter: return text + "Enter";
    case key::tab: return text + "Tab";
    case key::escape: return text + "Esc";
    case key::remove: return text + "Del";
    case key::backspace: return text + "Backspace";
    case key::home: return text + "Home";
    default: break;
    }
    if (press.key >= key::f1) return text + "F" + std::to_string(press.key - key::f1 + 1);
    return text + char(press.key);
}

std::string keys_of(const Shortcut& shortcut) {
    const std::string first = to_string(shortcut.press), second = to_string(shortcut.also);
    return second.empty() ? first : first + " or " + second;
}

std::span<const MouseHint> mouse_hints() { return hints; }

} // namespace blush
