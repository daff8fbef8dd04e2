#include "ui/panels/instruments.h"

#include "ui/panels/panels.h"
#include "ui/widgets/guide_pages.h"

#include <algorithm>

namespace blush {
namespace {

// An instrument whose open state is a flag in UiState.
template <auto flag> constexpr bool is_set(const PanelContext& c) { return *flag(c.ui); }
template <auto flag> constexpr void set(PanelContext& c, bool open) { *flag(c.ui) = open; }

template <auto flag> constexpr Instrument by_flag(const char* id, const char* title, const char* guide, DockSide side, float width,
                                                  float height, void (*draw)(PanelContext&), bool remembered = true) {
    return {id, title, guide, side, width, height, remembered, is_set<flag>, set<flag>, draw};
}

void close_region(PanelContext& c, bool open) {
    if (open) return;
    ViewSettings v = c.project().view;
    v.measured.reset();
    c.apply(SetView{v});
}

void open_roulette(PanelContext& c, bool open) {
    c.ui.roulette.open = open;
    if (open) return;
    // It measures as long as the panel is open.
    c.ui.roulette.runner.reset();
    c.ui.roulette.survivors.stop();
}

void open_strategies(PanelContext& c, bool open) {
    c.ui.strategies.open = open;
    if (open) return;
    // It renders as long as the panel is open.
    c.ui.strategies.runner.reset();
    c.ui.strategies.state = {};
}

void open_integrators(PanelContext& c, bool open) {
    c.ui.integrators.open = open;
    if (open) return;
    c.ui.integrators.runner.reset(); // it renders as long as the panel is open
    c.ui.integrators.state = {};
}

void open_sampler(PanelContext& c, bool open) {
    c.ui.sampler.open = open;
    if (open) return;
    c.ui.sampler.runner.reset(); // it measures as long as the panel is open
    c.ui.sampler.state = {};
}

void open_bleed(PanelContext& c, bool open) {
    c.ui.bleed.open = open;
    if (open) return;
    // It measures as long as the panel is open.
    c.ui.bleed.runner.reset();
    c.ui.bleed.map_runner.reset();
    c.ui.bleed.state = {};
    c.ui.bleed.map_state = {};
}

constexpr DockSide right = DockSide::right, bottom = DockSide::bottom;

const Instrument table[] = {
    by_flag<[](auto& ui) { return &ui.scopes.open; }>("scopes", "Scopes", guide_page::measuring, bottom, 42, 26, draw_scopes_panel),
    by_flag<[](auto& ui) { return &ui.light_table.open; }>("light_table", "Light table", guide_page::light_table, bottom, 44, 19,
                                                           draw_light_table),
    by_flag<[](auto& ui) { return &ui.convergence.open; }>("convergence", "Convergence", guide_page::chart, bottom, 50, 40,
                                                           draw_convergence_panel),
    by_flag<[](auto& ui) { return &ui.light_mix.open; }>("light_mix", "Light mix", guide_page::light_mix, right, 28, 30,
                                                         draw_light_mix_panel),
    by_flag<[](auto& ui) { return &ui.bounces.open; }>("bounces", "Bounces", guide_page::lab, right, 24, 24, draw_bounces_panel),
    {"roulette", "Roulette lab", guide_page::lab, right, 28, 44, true, [](const PanelContext& c) { return c.ui.roulette.open; },
     open_roulette, draw_roulette_panel},
    {"strategies", "Strategies", guide_page::strategies, bottom, 60, 26, true, [](const PanelContext& c) { return c.ui.strategies.open; },
     open_strategies, draw_strategies_panel},
    {"integrators", "Integrators", guide_page::integrators, bottom, 60, 26, true,
     [](const PanelContext& c) { return c.ui.integrators.open; }, open_integrators, draw_integrators_panel},
    {"samplers", "Samplers", guide_page::samplers, right, 28, 48, true, [](const PanelContext& c) { return c.ui.sampler.open; },
     open_sampler, draw_sampler_panel},
    by_flag<[](auto& ui) { return &ui.health.open; }>("health", "Health", guide_page::lab, right, 34, 34, draw_health_panel),
    by_flag<[](auto& ui) { return &ui.meters.open; }>("meters", "Light meters", guide_page::measuring, bottom, 36, 16, draw_meters_panel),
    by_flag<[](auto& ui) { return &ui.paths.open; }>("paths", "Paths", guide_page::paths, right, 26, 48, draw_paths_panel),
    {"lesson", "Lesson", guide_page::lessons, bottom, 60, 15, false, [](const PanelContext& c) { return c.ui.lesson.is_on(); },
     [](PanelContext& c, bool open) {
         if (!open) c.ui.lesson.to_end = true;
     },
     draw_lesson_panel},
    {"bleed", "Bleed", guide_page::bleed, right, 34, 40, true, [](const PanelContext& c) { return c.ui.bleed.open; }, open_bleed,
     draw_bleed_panel},
    by_flag<[](auto& ui) { return &ui.farm.open; }>("farm", "Farm", guide_page::farm, right, 28, 44, draw_farm_panel),
    by_flag<[](auto& ui) { return &ui.show_history; }>("history", "History", guide_page::docks, right, 18, 22, draw_history),
    by_flag<[](auto& ui) { return &ui.import_report.open; }>("import_report", "Import report", guide_page::own_file, right, 34, 30,
                                                             draw_import_report, false),
    {"comparison", "Comparison", guide_page::comparison, right, 24, 24, false,
     [](const PanelContext& c) { return c.ui.snapshots.compare.mode != Comparison::Mode::off; },
     [](PanelContext& c, bool open) {
         if (!open) c.ui.snapshots.compare.mode = Comparison::Mode::off;
     },
     draw_comparison_panel},
    {"snapshot", "Snapshot", guide_page::snapshots, right, 26, 26, false,
     [](const PanelContext& c) { return c.ui.snapshots.find(c.ui.snapshots.details) != nullptr; },
     [](PanelContext& c, bool open) {
         if (!open) c.ui.snapshots.details = 0;
     },
     draw_snapshot_panel},
    {"region", "Region", guide_page::measuring, bottom, 34, 18, false,
     [](const PanelContext& c) { return c.project().view.measured.has_value(); }, close_region, draw_region_panel},
    {"opening_page", "Start", guide_page::first_steps, bottom, 50, 20, false, [](const PanelContext& c) { return c.ui.opening_page; },
     [](PanelContext& c, bool open) { c.ui.opening_page = open; }, draw_start_page},
    {"pixel", "Pixel", guide_page::measuring, right, 26, 22, false, [](const PanelContext& c) { return c.ui.pixel.has_value(); },
     [](PanelContext& c, bool open) {
         if (!open) c.ui.pixel.reset();
     },
     draw_pixel_panel},
};

} // namespace

std::span<const Instrument> instruments() { return table; }

void toggle_instrument(PanelContext& c, const std::string& id) {
    const Instrument* i = find_instrument(table, id);
    if (!i) return;
    if (!i->is_open(c)) return i->set_open(c, true);
    if (c.ui.presentation.hidden.erase(id) > 0) return; // it was open, out of sight
    if (c.ui.docks.in_sight.contains(id) || c.ui.panels_hidden) return i->set_open(c, false);
    c.ui.docks.to_front.insert(id);
}

void restore_instruments(PanelContext c, const std::string& file) {
    const auto found = std::ranges::find(c.ui.settings.scenes, file, &SceneMemory::file);
    if (found == c.ui.settings.scenes.end()) return;
    for (const std::string& id : found->instruments)
        if (const Instrument* i = find_instrument(table, id); i && i->remembered) {
            i->set_open(c, true);
            c.ui.docks.open.push_back(id); // saved instruments do not come to the front of their dock
        }
    for (const std::string& id : c.ui.settings.dock.front) c.ui.docks.to_front.insert(id);
}

} // namespace blush
