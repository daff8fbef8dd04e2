#include "ui/panels/instruments.h"

#include "ui/panels/panels.h"

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
    if (!open) c.ui.roulette.runner.reset(); // it measures as long as the panel is open
}

namespace page {
constexpr const char* first = "guide/first-steps.html";
constexpr const char* file = "guide/first-steps.html#your-own-file";
constexpr const char* docks = "guide/first-steps.html#instruments-and-docks";
constexpr const char* light_table = "guide/lighting.html#light-table";
constexpr const char* mix = "guide/light-mix.html";
constexpr const char* measuring = "guide/display.html#measuring-the-picture";
constexpr const char* chart = "guide/convergence.html#the-chart";
constexpr const char* lab = "guide/convergence.html#roulette-lab-and-health";
constexpr const char* keep = "guide/snapshots.html#keep";
constexpr const char* compare = "guide/snapshots.html#compare";
} // namespace page

constexpr DockSide right = DockSide::right, bottom = DockSide::bottom;

const Instrument table[] = {
    by_flag<[](auto& ui) { return &ui.scopes.open; }>("scopes", "Scopes", page::measuring, bottom, 42, 26, draw_scopes_panel),
    by_flag<[](auto& ui) { return &ui.light_table.open; }>("light_table", "Light table", page::light_table, bottom, 44, 19,
                                                           draw_light_table),
    by_flag<[](auto& ui) { return &ui.convergence.open; }>("convergence", "Convergence", page::chart, bottom, 50, 40,
                                                           draw_convergence_panel),
    by_flag<[](auto& ui) { return &ui.light_mix.open; }>("light_mix", "Light mix", page::mix, right, 28, 30, draw_light_mix_panel),
    by_flag<[](auto& ui) { return &ui.bounces.open; }>("bounces", "Bounces", page::lab, right, 24, 24, draw_bounces_panel),
    {"roulette", "Roulette lab", page::lab, right, 28, 44, true, [](const PanelContext& c) { return c.ui.roulette.open; }, open_roulette,
     draw_roulette_panel},
    by_flag<[](auto& ui) { return &ui.health.open; }>("health", "Health", page::lab, right, 34, 34, draw_health_panel),
    by_flag<[](auto& ui) { return &ui.meters.open; }>("meters", "Light meters", page::measuring, bottom, 36, 16, draw_meters_panel),
    by_flag<[](auto& ui) { return &ui.show_history; }>("history", "History", page::docks, right, 18, 22, draw_history),
    by_flag<[](auto& ui) { return &ui.import_report.open; }>("import_report", "Import report", page::file, right, 34, 30,
                                                             draw_import_report, false),
    {"comparison", "Comparison", page::compare, right, 24, 24, false,
     [](const PanelContext& c) { return c.ui.snapshots.compare.mode != Comparison::Mode::off; },
     [](PanelContext& c, bool open) {
         if (!open) c.ui.snapshots.compare.mode = Comparison::Mode::off;
     },
     draw_comparison_panel},
    {"snapshot", "Snapshot", page::keep, right, 26, 26, false,
     [](const PanelContext& c) { return c.ui.snapshots.find(c.ui.snapshots.details) != nullptr; },
     [](PanelContext& c, bool open) {
         if (!open) c.ui.snapshots.details = 0;
     },
     draw_snapshot_panel},
    {"region", "Region", page::measuring, bottom, 34, 18, false,
     [](const PanelContext& c) { return c.project().view.measured.has_value(); }, close_region, draw_region_panel},
    {"opening_page", "Start", page::first, bottom, 50, 20, false, [](const PanelContext& c) { return c.ui.opening_page; },
     [](PanelContext& c, bool open) { c.ui.opening_page = open; }, draw_start_page},
    {"pixel", "Pixel", page::measuring, right, 26, 22, false, [](const PanelContext& c) { return c.ui.pixel.has_value(); },
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
    if (c.ui.docks.in_sight.contains(id) || c.ui.panels_hidden) return i->set_open(c, false);
    c.ui.docks.to_front.insert(id);
}

void recall_instruments(PanelContext c, const std::string& file) {
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
