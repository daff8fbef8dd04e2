// Region panel: mean, minimum, maximum and standard deviation in the measured rectangle, in scene-linear values, nits, stops and
// display values.
#include "core/text.h"
#include "ui/panels/panels.h"
#include "ui/snapshots/region_statistics.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <fmt/format.h>

namespace blush {
namespace {

void row(const char* name, const ValueStatistics& s, const char* format) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
    ImGui::TextUnformatted(name);
    ImGui::PopStyleColor();
    for (const double value : {s.mean, s.low, s.high, s.deviation}) {
        if (!ImGui::TableNextColumn()) continue;
        ImGui::TextUnformatted(s.count > 0 ? without_sign_of_zero(fmt::format(fmt::runtime(format), value)).c_str() : "-");
    }
}

void draw_table(const RegionStatistics& s) {
    if (!ImGui::BeginTable("statistics", 5, ImGuiTableFlags_SizingStretchSame)) return;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize("Luminance, nits").x);
    const bool narrow = ImGui::GetContentRegionAvail().x < 22 * ImGui::GetFontSize();
    // A narrow panel has room for two columns.
    constexpr std::pair<const char*, bool> columns[] = {{"Mean", true}, {"Min", false}, {"Max", true}, {"Std. dev.", false}};
    for (const auto& [name, always_shown] : columns)
        ImGui::TableSetupColumn(name, narrow && !always_shown ? ImGuiTableColumnFlags_Disabled : ImGuiTableColumnFlags_None);
    ImGui::TableHeadersRow();
    constexpr const char* linear[] = {"Linear R", "Linear G", "Linear B"};
    constexpr const char* displayed[] = {"Displayed R", "Displayed G", "Displayed B"};
    for (size_t k = 0; k < 3; ++k) row(linear[k], s.linear[k], "{:.4g}");
    row("Luminance, nits", s.nits, "{:.4g}");
    row("EV from grey", s.ev, "{:+.2f}");
    row("EV at ISO 100", s.ev100, "{:+.2f}");
    for (size_t k = 0; k < 3; ++k) row(displayed[k], s.displayed[k], "{:.3f}");
    ImGui::EndTable();
}

void draw_statistics(PanelContext& c, const RegionStatistics& s) {
    draw_table(s);
    c.ui.probe.record_last_item("Region/Statistics");
    const int64_t dark = int64_t(s.width) * s.height - s.ev.count;
    quiet_text(fmt::format("{} × {} pixels from {}, {}.{}", s.width, s.height, s.x, s.y,
                           dark > 0 ? fmt::format(" {} of them are black and have no EV.", dark) : ""));
}

} // namespace

void draw_region_panel(PanelContext& c) {
    if (!c.project().view.measured) return;
    if (!c.has_image()) return quiet_text("Waiting for the first render.");
    if (c.ui.region.update(c.shown_image(), region_statistics)) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, 0.05);
    if (const RegionStatistics* s = c.ui.region.output()) draw_statistics(c, *s);
}

} // namespace blush
