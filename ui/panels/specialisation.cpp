// Specialisation section: optional renderer features that this scene does not need, why, and what their absence saves; then those
// in use.
#include "ui/panels/panels.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

int64_t count(const FeatureReport& feature_report, bool used) { return std::ranges::count(feature_report, used, &FeatureUse::used); }

// Name and cost on one line, the reason below.
void draw_line(const FeatureUse& use) {
    const std::string cost = cost_text(use);
    const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(cost.c_str()).x;
    ImGui::TextUnformatted(use.name.c_str());
    ImGui::SameLine(std::max(right, ImGui::GetCursorPosX()));
    ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
    ImGui::TextUnformatted(cost.c_str());
    ImGui::PopStyleColor();
    quiet_text(use.why);
}

void draw_lines(const FeatureReport& feature_report, bool used) {
    std::string_view part;
    for (const FeatureUse& use : feature_report) {
        if (use.used != used) continue;
        if (part != use.part) {
            part = use.part;
            ImGui::Spacing();
            ImGui::PushFont(heading_font());
            ImGui::TextUnformatted(use.part.c_str());
            ImGui::PopFont();
        }
        draw_line(use);
    }
}

} // namespace

void draw_specialisation_section(PanelContext& c) {
    if (!section(c.ui, "Specialisation", false)) return;
    if (!c.frame || !c.frame->feature_report) return quiet_text("Nothing rendered yet.");
    FeatureReport feature_report = *c.frame->feature_report;
    if (c.window_features) feature_report.insert(feature_report.end(), c.window_features->begin(), c.window_features->end());
    quiet_text(fmt::format("{} of {} optional features are not compiled in or not built, because this scene does not need them. Kernel {}; "
                           "`blush info --measure` measures how much faster it is than the kernel with all features.",
                           count(feature_report, false), feature_report.size(), c.frame->kernel));
    draw_lines(feature_report, false);
    if (section(c.ui, "In use", false)) draw_lines(feature_report, true);
}

} // namespace blush
