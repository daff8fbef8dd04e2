// Samplers panel: a pair of dimensions of a pixel's samples, as random numbers and as Sobol points, and what they cost in the error.
#include "ui/lab_panel.h"
#include "ui/panels/panels.h"
#include "ui/widgets/plot_drawing.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/widgets/wrapped_text.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace blush {
namespace {

std::string with_capital(std::string text) {
    if (!text.empty()) text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

void draw_choices(PanelContext& c, SamplerView& view) {
    std::vector<std::string> names;
    std::vector<const char*> shown;
    for (int d = 0; d < SamplerView::dimensions; ++d) names.push_back(with_capital(sampler_dimension_name(uint32_t(d))));
    for (const std::string& name : names) shown.push_back(name.c_str());
    Fields f(c.ui, "Samplers");
    f.choice("Numbers", view.dimension, shown,
             "The pair of random numbers of each sample that is shown, by what the path tracer uses it for.");
    f.integer("Samples", view.points, 1, SamplerView::most_points, 64, "Of the middle pixel of the image, from the first one on.");
}

// The unit square with its points; those of the two half buffers differ in brightness.
void draw_square(ImDrawList& draw, const ImVec2& at, float side, const std::vector<SamplePoint>& points) {
    draw.AddRectFilled(at, {at.x + side, at.y + side}, tone::surround);
    constexpr int cells = 4;
    for (int i = 1; i < cells; ++i) {
        const float d = std::floor(side * float(i) / cells);
        draw.AddLine({at.x + d, at.y}, {at.x + d, at.y + side}, tone::field);
        draw.AddLine({at.x, at.y + d}, {at.x + side, at.y + d}, tone::field);
    }
    const float radius = std::max(1.2f, side * 0.012f);
    for (const SamplePoint& p : points)
        draw.AddCircleFilled({at.x + p.x * side, at.y + (1 - p.y) * side}, radius, p.half == 0 ? tone::text : tone::light);
}

void draw_points(PanelContext& c, const SamplerView& view) {
    const float gap = ImGui::GetFontSize(), side = std::floor(std::min((ImGui::GetContentRegionAvail().x - gap) / 2, 24 * gap));
    const float left = ImGui::GetCursorPosX();
    for (size_t i = 0; i < compared_samplers.size(); ++i) {
        if (i > 0) ImGui::SameLine(left + side + gap);
        ImGui::BeginGroup();
        ImGui::TextUnformatted(sampler_names[i]);
        draw_square(*ImGui::GetWindowDrawList(), ImGui::GetCursorScreenPos(), side,
                    sample_points(compared_samplers[i], c.render_width / 2, c.render_height / 2, c.project().render.seed,
                                  uint32_t(view.dimension), int(view.points)));
        ImGui::Dummy({side, side});
        c.ui.probe.record_last_item(fmt::format("Samplers/{}", sampler_names[i]));
        tip_for_last_item(c.ui, "Each point is a sample. The two colours are the half buffers, whose difference measures the error: each "
                                "has a sequence of its own.");
        ImGui::EndGroup();
    }
}

void draw_chart(PanelContext& c, const SamplerReport& report) {
    const float em = ImGui::GetFontSize();
    const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x, 1.f), 16 * em}, origin = ImGui::GetCursorScreenPos();
    const ImFont& font = *ImGui::GetFont();
    const Plot plot = sampler_plot(report);
    draw_plot(*ImGui::GetWindowDrawList(), plot, compute_plot_layout(plot, plot_metrics(size, font, em, true)), origin, font, em,
              plot_tones_dark());
    ImGui::Dummy(size);
    c.ui.probe.record_last_item(fmt::format("Samplers/Chart of {} pairs", report.pairs));
}

} // namespace

void draw_sampler_report(PanelContext& c, const SamplerReport& report) {
    const std::string text = sampler_gain_text(report);
    if (text.empty()) return quiet_text("The first images are being rendered.");
    draw_chart(c, report);
    wrapped_text(text);
    quiet_text(fmt::format("From {} pairs of images of {} × {} pixels that differ in the seed alone: half their mean squared difference is "
                           "the mean squared error of each.",
                           report.pairs, report.width, report.height));
}

void draw_sampler_panel(PanelContext& c) {
    SamplerView& view = c.ui.sampler;
    draw_choices(c, view);
    draw_points(c, view);
    quiet_text("Sobol points fill the square evenly in every pair of dimensions; random numbers leave gaps and clumps. The image's error "
               "shows what that is worth.");
    if (!section(c.ui, "Error")) {
        view.runner.reset(); // it measures only while that is shown
        return;
    }
    if (const std::string& failure = measure_while_open(c, view, SamplerWork::Input{c.scene(), lab_image_settings(c)}); !failure.empty())
        return quiet_text(failure);
    draw_sampler_report(c, view.state.output);
}

} // namespace blush
