#include "core/math.h"
#include "core/srgb.h"
#include "core/text.h"
#include "ui/panels/paths/sections.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/widgets.h"
#include "ui/widgets/wrapped_text.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

constexpr size_t most_rows = 64;

const char* shown_name(FoundBy by) {
    constexpr std::array names{"hit", "guided", "NEE", "manifold", "light vertex", "light path"};
    static_assert(names.size() == size_t(found_by_count));
    return names[size_t(by)];
}

// A reflectance as it is, a light at full brightness.
ImU32 swatch_color(const Vec3& color) {
    const float largest = max_component(color);
    if (largest > 1) return hue_of(color);
    const auto encoded = [](float x) { return int(255 * srgb_from_linear(std::clamp(x, 0.f, 1.f))); };
    return IM_COL32(encoded(color.x), encoded(color.y), encoded(color.z), 255);
}

void swatch(const Vec3& color, float em) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = em * 0.8f, top = at.y + em * 0.15f;
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + side, top + side}, swatch_color(color));
    ImGui::GetWindowDrawList()->AddRect({at.x, top}, {at.x + side, top + side}, tone::line);
    ImGui::Dummy({side, em});
}

// A paragraph for each part between semicolons.
void paragraphs(std::string_view text, ImU32 color, float indent) {
    if (indent > 0) ImGui::Indent(indent); // 0 is ImGui's own distance
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    for (const std::string_view part : split(text, ';')) wrapped_text(part.starts_with(' ') ? part.substr(1) : part);
    ImGui::PopStyleColor();
    if (indent > 0) ImGui::Unindent(indent);
}

void draw_vertex(PanelContext& c, const PathVertex& v, RgbChannel channel) {
    const float em = ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x;
    ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
    ImGui::TextUnformatted(fmt::format("{}", v.bounce).c_str());
    ImGui::PopStyleColor();
    ImGui::SameLine(em * 1.6f + ImGui::GetStyle().WindowPadding.x);
    swatch(v.color, em);
    ImGui::SameLine(0, em * 0.5f);
    elided_text(c.ui, v.object, tone::text, width * 0.42f - em * 2);
    c.ui.probe.record_last_item(fmt::format("Paths/Vertex {}", v.bounce));
    ImGui::SameLine(width * 0.45f + ImGui::GetStyle().WindowPadding.x);
    elided_text(c.ui, step_text(v, channel), tone::text);
}

} // namespace

void draw_path_arithmetic(PanelContext& c, const RecordedPath& path) {
    const PathsView& view = c.ui.paths;
    const RgbChannel channel = view.channel_of(path);
    const std::vector<PathTerm> terms = terms_of(path, channel);
    const size_t shown = view.shown_vertices();
    const float em = ImGui::GetFontSize();
    float sum = 0;
    for (size_t k = 0; k < shown; ++k) {
        if (k < most_rows) draw_vertex(c, path.vertices[k], channel);
        for (const PathTerm& term : terms) {
            if (term.vertex != k) continue;
            sum += term.value;
            if (k < most_rows)
                paragraphs(fmt::format("{}:  {}", shown_name(term.by), term.text), term.value > 0 ? tone::light : tone::failure, em * 1.6f);
        }
    }
    if (shown > most_rows) quiet_text(fmt::format("{} more vertices", shown - most_rows));
    ImGui::Dummy({0, em * 0.2f});
    const bool all = shown == path.vertices.size();
    paragraphs(fmt::format("{} in {}: {:.4g} nits", all ? "Contribution" : "So far", to_string(channel), sum), tone::text, 0);
    c.ui.probe.record_last_item("Paths/Contribution");
    if (!path.is_valid()) quiet_text("The film leaves this sample out: it is not finite or negative.");
}

} // namespace blush
