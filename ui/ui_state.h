// All state of the window that is not the document: selection, open panels, tool, and what panels ask the editor to do.
#pragma once

#include "scene/scene.h"
#include "ui/aov_view.h"
#include "ui/bounces_view.h"
#include "ui/camera_frame.h"
#include "ui/convergence_view.h"
#include "ui/denoise_view.h"
#include "ui/dock.h"
#include "ui/file_request.h"
#include "ui/gestures.h"
#include "ui/health_view.h"
#include "ui/home_view.h"
#include "ui/import_report_view.h"
#include "ui/light_mix_view.h"
#include "ui/light_presence.h"
#include "ui/map_view.h"
#include "ui/meters_view.h"
#include "ui/picture_zoom.h"
#include "ui/probe.h"
#include "ui/question.h"
#include "ui/region_statistics.h"
#include "ui/roulette_view.h"
#include "ui/scopes_view.h"
#include "ui/shortcuts.h"
#include "ui/snapshots_view.h"
#include "ui/time_view.h"
#include "ui/toasts.h"
#include "ui/transform_view.h"
#include "ui/value_editing.h"
#include "ui/window_settings.h"

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace blush {

struct Difference;

enum class InspectorTab { selection, camera, environment, render, display };

// What a click or drag in the picture does instead of navigating, once.
enum class ViewTool {
    none,
    pick_white, // a click says what is to look neutral
    measure,    // a drag says which rectangle has its statistics shown
    pick_color, // a click says which colour a field becomes
    region,     // a drag says which rectangle is rendered
    meter,      // a click puts a light meter on a surface
};
// Where in the picture a tool's drag began, (0, 0) top left, (1, 1) bottom right.
struct ToolStart {
    double u = 0, v = 0;
};

// The file dialog, while it is open.
struct FileBrowser {
    FileRequest::Use use = FileRequest::Use::open;
    std::filesystem::path folder;
    std::string typed; // the path field
    std::string chosen;
    bool just_opened = true;
    std::filesystem::path scene_folder = {}; // of the open scene
    bool on_desktop = false; // the desktop's own dialog asks: ours is not drawn
};

// A pixel whose values are shown.
struct PixelProbe {
    double u = 0, v = 0; // of the image, (0, 0) top left
    bool just_opened = true;
};

// Angles as the user typed them, kept while the rotation they belong to stays: a quaternion alone would make them jump.
struct EulerFields {
    Id<Node> node;
    Quat rotation;
    Vec3d degrees{0, 0, 0};
};

// The temperature of a white as the user typed it, kept while that white stays.
struct WhiteFields {
    Vec3 color{0, 0, 0};
    float kelvin = 0, green_tint = 0;
};

// A camera's exposure, of which only the stops are the document's.
struct ExposureTriangle {
    float f_number = 8, iso = 100; // f_number: where the lens is a pinhole
};

// What a click into the picture decides about the selected light.
enum class PlacingBy { hand, highlight, shadow };

// The light whose eyes the viewport sees with, and the view to go back to.
struct LookedThrough {
    Id<Node> node;
    View back;
};

struct LightTableView {
    bool open = false;
    Id<Node> renaming;          // this row's node
    std::string renaming_group; // or this group
    std::string text;
    bool just_begun = false;
};

// A place in the picture, (0, 0) top left.
struct PicturePoint {
    double u = 0, v = 0;
};

// How long the mouse has rested on a widget.
struct TipTimer {
    Region item;
    double since = 0; // seconds of ImGui's clock
    int frame = -1;   // in which it was last hovered
};

struct UiState {
    Id<Node> selected;                   // what handles and inspector are for
    std::vector<Id<Node>> also_selected; // edited together with it
    Id<Material> selected_material;
    std::set<Id<Node>> turned;       // the outliner's rows that are not folded as they are at first
    bool scroll_to_selected = false; // the outliner brings it into view
    InspectorTab tab = InspectorTab::selection;
    Id<Node> renaming;
    std::string rename_text;

    PictureZoom zoom;
    std::optional<PicturePoint> cursor; // while it is over the picture and nothing lies between
    ViewTool tool = ViewTool::none;
    std::optional<ToolStart> tool_start; // while it drags
    DenoiseView denoise; // a way of looking, not of rendering: apart from the document and its history
    bool paused = false;
    double next_frame_in = 1e9; // seconds until something moves by itself: a toast that goes, a tooltip that comes
    PlacingBy placing_by = PlacingBy::hand;
    std::optional<LookedThrough> looked_through;
    LightTableView light_table;
    bool show_shortcuts = false;
    bool studio_at_opening = false;  // the file has no light; it was opened in the studio rig, and the banner still says so
    bool opening_page = false;       // of a start without a scene
    std::vector<std::string> demos;  // scene files that come with the program
    bool panels_hidden = false; // all but menu, picture and status bar
    HomeView home;              // where `Camera's view` goes back to
    CameraFrame frame;          // of that camera
    TransformView transform;    // of the selection, by gizmo or keys
    bool show_history = false;
    LightMixView light_mix;
    BouncesView bounces;
    AovView aov; // what the bar of the viewport shows
    HealthView health;
    ImportReportView import_report;
    RouletteView roulette;
    SnapshotsView snapshots;
    std::shared_ptr<const Difference> difference; // of what is compared, as last worked out; null: none
    ScopesView scopes;
    MetersView meters;
    RegionView region;
    ConvergenceView convergence;
    std::optional<FileBrowser> browser;
    std::optional<Question> question; // asked by the editor, which also hears the answer
    std::optional<PixelProbe> pixel;
    EulerFields euler;
    WhiteFields white;
    ExposureTriangle triangle;
    LightPresence light_presence;
    ValueEditing values;
    MapView maps;
    TimeView time;

    WindowSettings settings; // remembered between starts
    GestureTracker gestures;
    TipTimer tip;
    DockView docks;
    Probe probe;
    Toasts toasts;

    // Done by the editor after the panels are drawn.
    std::vector<Command> commands;
    std::vector<FileRequest> files;
    bool meter_exposure = false; // once, of the picture that answers the last edit: its surroundings are other ones

    // What the viewport shows instead of the picture, if some panel asks for it.
    PictureView picture_view(int bounce_planes) const {
        if (health.open && health.map) return {PictureView::Show::dropped};
        if (roulette.open && roulette.map == RouletteView::Map::path_length) return {PictureView::Show::path_length};
        if (roulette.open && roulette.map == RouletteView::Map::survival) return {PictureView::Show::survival};
        const PictureView by_panel = blush::picture_view(bounces, bounce_planes);
        return by_panel.show == PictureView::Show::beauty ? blush::picture_view(aov, bounce_planes) : by_panel;
    }
    // Film planes that open panels read, beside those that every frame has.
    PlaneSet wanted_planes() const {
        PlaneSet planes = planes_of(aov);
        if (bounces.open) planes.bounces = usual_bounce_planes;
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
    // Adds what is not selected and takes away what is.
    void toggle(Id<Node> node);
    // All from the one selected to this one, in the order in which they are listed. Where the one selected is not listed, this one alone.
    void select_range(std::span<const Id<Node>> listed, Id<Node> to);
    bool is_selected(Id<Node> node) const;
    // It is the environment that is looked at.
    bool environment_chosen() const { return tab == InspectorTab::environment && !selected; }
    // All that is selected and still there; the one selected first.
    std::vector<Id<Node>> selection(const Scene& scene) const;
};

} // namespace blush
