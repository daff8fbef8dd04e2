// All UI state that is not in the document: selection, open panels, tool, and requests of panels to the editor.
#pragma once

#include "scene/scene.h"
#include "ui/lights/light_presence.h"
#include "ui/snapshots/aov_view.h"
#include "ui/snapshots/region_statistics.h"
#include "ui/snapshots/snapshots_view.h"
#include "ui/transform/transform_view.h"
#include "ui/viewport/camera_frame.h"
#include "ui/viewport/image_zoom.h"
#include "ui/views/bleed_view.h"
#include "ui/views/bounces_view.h"
#include "ui/views/convergence_view.h"
#include "ui/views/denoise_view.h"
#include "ui/views/farm_view.h"
#include "ui/views/health_view.h"
#include "ui/views/home_view.h"
#include "ui/views/import_report_view.h"
#include "ui/views/lab/integrators_view.h"
#include "ui/views/lab/roulette_view.h"
#include "ui/views/lab/sampler_view.h"
#include "ui/views/lab/strategies_view.h"
#include "ui/views/lesson_view.h"
#include "ui/views/light_mix_view.h"
#include "ui/views/map_view.h"
#include "ui/views/meters_view.h"
#include "ui/views/paths_view.h"
#include "ui/views/presentation_view.h"
#include "ui/views/scopes_view.h"
#include "ui/views/time_view.h"
#include "ui/widgets/value_editing.h"
#include "ui/window/dock.h"
#include "ui/window/file_request.h"
#include "ui/window/gestures.h"
#include "ui/window/modal_dialog.h"
#include "ui/window/probe.h"
#include "ui/window/shortcuts.h"
#include "ui/window/toasts.h"
#include "ui/window/window_settings.h"

#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace blush {

struct Difference;

enum class InspectorTab { selection, camera, environment, render, display };

// Tools: the next click or drag in the image does this instead of navigating, once.
enum class ViewTool {
    none,
    pick_white, // click: this pixel becomes neutral white
    measure,    // drag: rectangle for statistics
    pick_color, // click: a colour field gets the pixel's colour
    region,     // drag: render region
    meter,      // click: places a light meter on a surface
    paths,      // click or drag: shows the paths of a pixel or of a rectangle
    bleed,      // click or drag: the bleed probe measures this point or rectangle
};
// Start of a tool's drag in the image, (0, 0) top left, (1, 1) bottom right.
struct ToolStart {
    double u = 0, v = 0;
};

// The file dialog, while it is open.
struct FileBrowser {
    FileRequest::Use use = FileRequest::Use::open;
    std::filesystem::path folder;
    std::string typed;  // the path field
    std::string chosen; // file in `folder`, or a folder that the arrow keys have reached
    bool just_opened = true;
    std::filesystem::path scene_folder = {}; // of the open scene
    bool on_desktop = false;                 // the desktop's dialog is open: the file browser is not drawn
    bool scroll_to_chosen = false;
};

// The pixel whose values are shown.
struct PixelProbe {
    double u = 0, v = 0; // in the image, (0, 0) top left
    bool just_opened = true;
};

// Euler angles as the user typed them, kept while the rotation does not change elsewhere: from a quaternion alone they could
// jump.
struct EulerFields {
    Id<Node> node;
    Quat rotation;
    Vec3d degrees{0, 0, 0};
};

// The white's temperature as the user typed it, kept while the white does not change elsewhere.
struct WhiteFields {
    Vec3 color{0, 0, 0};
    float kelvin = 0, green_tint = 0;
};

// Camera exposure settings; the document has only the stops.
struct ExposureTriangle {
    float f_number = 8, iso = 100; // f_number: used while the lens is a pinhole
};

// The effect of a click in the image on the selected light.
enum class PlacingBy { hand, highlight, shadow };

// The light of the light camera, and the view to return to.
struct LookedThrough {
    Id<Node> node;
    View back;
};

struct LightTableView {
    bool open = false;
    Id<Node> renaming;          // the node that is being renamed
    std::string renaming_group; // or the group
    std::string text;
    bool just_begun = false;
};

// A point in the image, (0, 0) top left.
struct ImagePosition {
    double u = 0, v = 0;
};

// How long the mouse has been over a widget without moving.
struct TipTimer {
    Region item;
    double since = 0; // seconds of ImGui's clock
    int frame = -1;   // in which it was last hovered
};

// For Left and Right in the menus of the menu bar.
struct MenuBarView {
    int open = -1;    // the menu that is open; -1: none
    int turn = 0;     // to the next menu or the previous one, if the open menu has no use for the key
    int to_open = -1; // in this frame
};

struct UiState {
    Id<Node> selected;                   // the active node: used by handles and inspector
    std::vector<Id<Node>> also_selected; // edited together with it (multi-edit)
    Id<Material> selected_material;
    std::set<Id<Node>> turned;       // outliner rows whose fold state differs from the default
    bool scroll_to_selected = false; // the outliner scrolls to it
    InspectorTab tab = InspectorTab::selection;
    Id<Node> renaming;
    std::string rename_text;

    ImageZoom zoom;
    std::optional<ImagePosition> cursor; // while the mouse is over the image and no other window
    ViewTool tool = ViewTool::none;
    std::optional<ToolStart> tool_start; // while the tool's drag is active
    DenoiseView denoise;                 // view setting: not part of the document and its history
    bool paused = false;
    double seconds_to_next_frame = 1e9; // seconds until a frame is needed without input, for example for toasts and tooltips
    PlacingBy placing_by = PlacingBy::hand;
    std::optional<LookedThrough> light_camera;
    LightTableView light_table;
    bool show_shortcuts = false;
    std::optional<std::string> guide_page; // page of the guide to open in a browser (guide_pages.h)
    bool studio_banner = false;            // the file has no light and was opened with studio lighting; the banner is still shown
    bool opening_page = false;             // shown after a start without a scene
    std::vector<std::string> demos;        // scene files shipped with the program
    bool panels_hidden = false;            // hides everything except menu, image and status bar
    HomeView home;                         // target of the command Camera view
    CameraFrame frame;                     // of that camera
    TransformView transform;               // of the selection, by gizmo or keys
    bool show_history = false;
    MenuBarView menu_bar;
    LessonView lesson;
    PresentationView presentation;
    LightMixView light_mix;
    BleedView bleed;
    BouncesView bounces;
    AovView aov;                                      // the AOV selected in the viewport's toolbar
    std::array<float, 2> two_piles{1 / 3.f, 2 / 3.f}; // the wipes of that AOV, in the image
    HealthView health;
    ImportReportView import_report;
    RouletteView roulette;
    StrategiesView strategies;
    IntegratorsView integrators;
    SamplerView sampler;
    SnapshotsView snapshots;
    std::shared_ptr<const Difference> difference; // of the compared images, as last computed; null: none
    ScopesView scopes;
    MetersView meters;
    PathsView paths;
    FarmView farm;
    RegionView region;
    ConvergenceView convergence;
    std::optional<FileBrowser> browser;
    std::optional<ModalDialog> dialog; // set by the editor, which also receives the answer
    std::optional<PixelProbe> pixel;
    EulerFields euler;
    WhiteFields white;
    ExposureTriangle triangle;
    LightPresence light_presence;
    ValueEditing values;
    MapView maps;
    TimeView time;

    WindowSettings settings; // saved between starts
    GestureTracker gestures;
    TipTimer tip;
    DockView docks;
    Probe probe;
    Toasts toasts;

    // Executed by the editor after the panels are drawn.
    std::vector<Command> commands;
    std::vector<FileRequest> files;
    bool wraps_cursor = false;   // a drag without an end: the cursor that leaves the window comes back in at the opposite edge
    bool meter_exposure = false; // once, for the image of the last edit, because the environment has changed

    // The special view that the viewport shows instead of the image, if a panel requests one.
    ImageView image_view(int bounce_planes) const {
        if (health.open && health.map) return {ImageView::Show::dropped};
        if (roulette.open && roulette.map == RouletteView::Map::path_length) return {ImageView::Show::path_length};
        if (roulette.open && roulette.map == RouletteView::Map::survival) return {ImageView::Show::survival};
        const ImageView by_panel = blush::image_view(bounces, bounce_planes);
        if (by_panel.show != ImageView::Show::beauty) return by_panel;
        ImageView by_aov = blush::image_view(aov, bounce_planes);
        if (by_aov.show == ImageView::Show::two_piles) by_aov.wipes = two_piles;
        return by_aov;
    }
    // Film planes that open panels need, in addition to the default ones.
    PlaneSet wanted_planes() const {
        PlaneSet planes = planes_of(aov);
        if (bounces.open) planes.bounces = default_bounce_planes;
        planes.roulette = roulette.open && roulette.map != RouletteView::Map::none;
        return planes;
    }

    void select(Id<Node> node, Id<Material> material = {}) {
        also_selected.clear();
        selected = node;
        selected_material = material;
        scroll_to_selected = true;
        tab = InspectorTab::selection;
    }
    // Toggles the selection of a node.
    void toggle(Id<Node> node);
    // Selects all from the active node to this one, in list order. If the active node is not in the list, selects only this one.
    void select_range(std::span<const Id<Node>> listed, Id<Node> to);
    bool is_selected(Id<Node> node) const;
    // The environment's inspector is shown.
    bool environment_chosen() const { return tab == InspectorTab::environment && !selected; }
    // All selected nodes that still exist; the active one first.
    std::vector<Id<Node>> selection(const Scene& scene) const;
};

} // namespace blush
