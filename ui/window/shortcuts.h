// All commands with their keys, in one table: used by dispatch, menus and the shortcut sheet.
#pragma once

#include <span>
#include <string>

namespace blush {

// Key codes of GLFW; letters are their upper-case ASCII codes.
namespace key {
constexpr int none = 0, space = 32, zero = 48, escape = 256, enter = 257, tab = 258, backspace = 259, remove = 261, right = 262, left = 263,
              down = 264, up = 265, home = 268, f1 = 290;
constexpr int pad_zero = 320, pad_point = 330, pad_minus = 333, pad_enter = 335; // of the number pad
} // namespace key

struct KeyPress {
    int key = key::none;
    bool ctrl = false, shift = false, alt = false;
    char32_t typed = 0; // the character typed in the current keyboard layout; 0: none or unknown
    // Compares keys and modifiers; ignores `typed`.
    bool operator==(const KeyPress& o) const { return key == o.key && ctrl == o.ctrl && shift == o.shift && alt == o.alt; }
};

enum class Command {
    open,
    import_scene,
    environment,
    ies,
    reload,
    import_report,
    map,
    save_scene,
    save_scene_as,
    snapshot_exr,
    snapshot_png,
    snapshot_folder,
    snapshots_beside_scene,
    farm,
    farm_looks,
    snapshot_strip,
    dock_all,
    undelete_snapshot,
    compare_wipe,
    compare_flicker,
    compare_difference,
    quit,
    undo,
    redo,
    copy_value,
    paste_value,
    reset_value,
    duplicate,
    remove,
    add_ground,
    add_catcher,
    rename,
    add_point,
    add_spot,
    add_sun,
    add_rectangle,
    add_disk,
    add_sphere,
    light_by_studio,
    light_by_sky,
    mute,
    solo,
    group_lights,
    place_highlight,
    place_shadow,
    look_through_light,
    light_table,
    grab,
    rotate,
    scale,
    next_gizmo,
    local_axes,
    frame_selection,
    frame_all,
    camera_view,
    toggle_projection,
    toggle_overlays,
    toggle_panels,
    full_screen,
    presentation,
    toggle_zoom,
    exposure_up,
    exposure_down,
    exposure_reset,
    exposure_meter,
    exposure_auto,
    pick_white,
    reset_white,
    toggle_denoise,
    pause,
    clear_selection,
    guide,
    shortcuts,
    history,
    light_mix,
    bounces,
    next_aov,
    previous_aov,
    health,
    roulette,
    strategies,
    integrators,
    samplers,
    measure,
    meters,
    paths,
    bleed,
    render_region,
    render_all,
    scopes,
    convergence,
    load_convergence,
};
constexpr Command last_command = Command::load_convergence; // of the enumeration

struct Shortcut {
    Command command;
    const char* group;
    const char* name;   // in the menu
    KeyPress press;     // key::none: only in the menu
    KeyPress also = {}; // second key for the same command
};

std::span<const Shortcut> shortcuts();
const Shortcut& shortcut(Command command);
// The command for a key press, or nullptr.
const Shortcut* find_shortcut(const KeyPress& press);
// "Ctrl+Shift+Z"; empty without a key.
std::string to_string(const KeyPress& press);
// Both keys of a command: "F12 or Ctrl+Enter".
std::string keys_of(const Shortcut& shortcut);

// Mouse controls of the viewport, for the shortcut sheet.
struct MouseHint {
    const char* action;
    const char* gesture;
};
std::span<const MouseHint> mouse_hints();

} // namespace blush
