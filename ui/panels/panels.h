// The panels: each is one function that draws from the project and applies edits; one file each.
#pragma once

#include "ui/panel_context.h"

#include <imgui.h>

#include <string>
#include <vector>

namespace blush {

class Fields;
struct RouletteReport;
struct StrategyReport;

// Regions of the layout, drawn into the current ImGui window.
void draw_menu_bar(PanelContext& c);
void draw_outliner(PanelContext& c);
// Page of the guide about what the inspector's tab shows.
const char* inspector_guide_page(const PanelContext& c);
void draw_inspector(PanelContext& c); // tabs, each made of the sections below
void draw_status_bar(PanelContext& c);
void draw_time(PanelContext& c); // for scenes with animations

// Sections of the inspector.
void draw_object_panel(PanelContext& c, Id<Node> node);
void draw_transform_panel(PanelContext& c, Id<Node> node);
void draw_morph_weights_panel(PanelContext& c, Id<Node> node);
void draw_light_panel(PanelContext& c, Id<Node> node);
void draw_light_links_panel(PanelContext& c, Id<Node> node);
void draw_material_panel(PanelContext& c, Id<Node> node);    // the selected material, or the material of the node's mesh
void draw_camera_panel(PanelContext& c);                     // the view
void draw_camera_node_panel(PanelContext& c, Id<Node> node); // one of the scene's cameras
void draw_environment_panel(PanelContext& c);
void draw_render_panel(PanelContext& c);
void draw_specialisation_section(PanelContext& c); // of the Render tab
void draw_display_panel(PanelContext& c);

// Instruments (instruments.h), each into the current ImGui window.
void draw_history(PanelContext& c);
// Chooses which layer of an image from another program is shown; draws nothing for a snapshot.
void draw_layer_choice(Fields& f, Snapshot& image, const char* label);
void draw_comparison_panel(PanelContext& c);
void draw_snapshot_panel(PanelContext& c); // name, note and file of one snapshot
void draw_pixel_panel(PanelContext& c);
void draw_meters_panel(PanelContext& c);
void draw_bleed_panel(PanelContext& c);
void draw_region_panel(PanelContext& c);
void draw_paths_panel(PanelContext& c);
void draw_scopes_panel(PanelContext& c);
void draw_bounces_panel(PanelContext& c);
void draw_lesson_panel(PanelContext& c);
void draw_light_mix_panel(PanelContext& c);
void draw_health_panel(PanelContext& c);
void draw_farm_panel(PanelContext& c);
void draw_import_report(PanelContext& c);
void draw_roulette_panel(PanelContext& c);
void draw_roulette_report(PanelContext& c, const RouletteReport& report); // the lower part of that panel: the measurements
void draw_sampler_panel(PanelContext& c);
void draw_sampler_report(PanelContext& c, const SamplerReport& report); // the lower part of that panel: the measurements
void draw_integrators_panel(PanelContext& c);
void draw_integrator_report(PanelContext& c, const IntegratorReport* report); // that panel without its job; null: no round yet
void draw_strategies_panel(PanelContext& c);
void draw_strategy_report(PanelContext& c, const StrategyReport* report); // that panel without its job; null: no round yet
void draw_light_table(PanelContext& c);
void draw_convergence_panel(PanelContext& c);
// Runs the meters, even if their panel is closed: the image shows their readings.
void follow_meters(PanelContext& c);

// Drawn above everything else, each in its own window while it is open.
void draw_file_browser(PanelContext& c);
void draw_shortcut_sheet(PanelContext& c);
void draw_pixel_popup(PanelContext& c); // replaces the panel while panels are hidden
void draw_modal_dialog(PanelContext& c);
void draw_start_page(PanelContext& c); // also an instrument
// At the upper edge of the viewport, while the scene has no light at all.
void draw_no_light_banner(PanelContext& c, const Region& viewport);
// At the left of the image: which gizmo is shown, and its axes.
void draw_gizmo_bar(PanelContext& c, const Region& image);

// A running background job.
struct RunningJob {
    std::string title, what;
    double fraction = 0;
    bool can_cancel = false;
};
// In the lower right corner of the viewport: toasts, stacked, and below them the running job (null: none). Returns true if its
// Cancel button is pressed.
bool draw_cards(PanelContext& c, const Region& viewport, const RunningJob* job);

} // namespace blush
