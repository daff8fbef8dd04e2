// Integrators panel: another integrator beside path tracing at equal time, with its error over time and where it is wrong.
#include "ui/lab_panel.h"
#include "ui/panels/integrators/integrator_fields.h"
#include "ui/panels/panels.h"
#include "ui/views/lab/integrators_view.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/plot_drawing.h"
#include "ui/widgets/segments.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/widgets/wrapped_text.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>

namespace blush {
namespace {

using Show = IntegratorsView::Show;

constexpr float least_image = 4; // height, ems

void draw_choices(PanelContext& c, IntegratorsView& view) {
    static constexpr const char* metrics[] = {"RMSE", "relMSE"};
    const float gap = ImGui::GetFontSize();
    const int kind =
        segments(c.ui, "Integrators/Integrator", integrator_names, int(view.integrator.kind) - 1,
                 "Direct light is that of the path tracer in the first four. Ambient light: the same light from all sides, times "
                 "ambient occlusion. Irradiance cache: few points, interpolated. Light probes: a grid of spherical harmonics. "
                 "Photon map: the density of light paths. PPM, progressive photon mapping: a new map for each sample, with smaller "
                 "disks. BDPT, bidirectional path tracing: each vertex of a camera path is connected with each of a light path. "
                 "MLT, Metropolis light transport: paths that find much light are mutated. The last three find all light their own way.");
    choose_integrator(view.integrator, ComparisonIntegrator::Kind(kind + 1));
    same_line_if_fits(segments_width(IntegratorsView::show_names), gap);
    view.show = Show(segments(c.ui, "Integrators/Show", IntegratorsView::show_names, int(view.show),
                              "Wipe: drag the bar; path tracing is on its left. Difference: blue is too dark, red too bright; frames mark "
                              "regions whose mean differs by more than noise."));
    same_line_if_fits(segments_width(metrics), gap);
    view.metric = ErrorMetric(segments(c.ui, "Integrators/Error", metrics, int(view.metric),
                                       "RMSE: root mean squared error, in nits. relMSE: mean of the squared error divided by the squared "
                                       "value. Path tracing: estimated from its half buffers. The other: measured against path tracing."));
}

void text_line(PanelContext& c, const std::string& text, ImU32 color, float width, const std::string& record = {}) {
    elided_text(c.ui, text, color, width);
    if (!record.empty()) c.ui.probe.record_last_item("Integrators/" + record);
}

struct Column {
    std::string name;
    const char* record;
    const IntegratorSide* side; // null: no round yet
    Interval error;
    std::string color;
};

Column column_of(const IntegratorsView& view, const IntegratorReport* r, bool biased) {
    if (!biased)
        return {"Path tracing", "Path", r ? &r->path : nullptr, r ? r->path.noise_error(view.metric) : Interval{}, plot_color_on_dark(0)};
    return {fmt::format("{} ({})", integrator_name(view.integrator.kind), verdict_of(view.integrator.kind)), "Biased",
            r ? &r->biased : nullptr, r ? r->latest_error(view.metric) : Interval{}, plot_color_on_dark(1)};
}

// The colour of its curve.
void draw_mark(const Column& column) {
    const float em = ImGui::GetFontSize();
    const ImVec2 mark = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled({mark.x, mark.y + em * 0.2f}, {mark.x + em * 0.7f, mark.y + em * 0.9f},
                                              parse_color(column.color));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + em);
}

// Its samples and time in the line of the mark, and the error below.
void draw_numbers(PanelContext& c, const Column& column, float width) {
    const float em = ImGui::GetFontSize();
    draw_mark(column);
    if (!column.side) {
        text_line(c, column.name, tone::text, width - em);
        return text_line(c, "", tone::dim_text, width);
    }
    text_line(c, fmt::format("{} spp, {:.2f} s", column.side->samples, column.side->seconds), tone::text, width - em,
              fmt::format("{}/{} samples in {:.3f} s", column.record, column.side->samples, column.side->seconds));
    tip_for_last_item(c.ui, column.name.c_str());
    const Interval& e = column.error;
    const char* const metric = c.ui.integrators.metric == ErrorMetric::rmse ? "RMSE" : "relMSE";
    text_line(c,
              e.known ? fmt::format("{} {:.3g} ({:.3g} to {:.3g})", metric, e.value, e.low, e.high) : fmt::format("{} not known", metric),
              e.known ? tone::text : tone::dim_text, width, fmt::format("{}/Error {}", column.record, e.known ? "known" : "not known"));
}

// Half 0 or 1 of the sheet, between the shares `from` and `to` of its width.
void draw_half(PanelContext& c, const ImVec2& at, const ImVec2& size, int half, float from = 0, float to = 1) {
    if (!c.integrators) return;
    const float x0 = std::round(at.x + from * size.x), x1 = std::round(at.x + to * size.x), v = float(half) / 2;
    ImGui::GetWindowDrawList()->AddImage(c.integrators, {x0, at.y}, {x1, at.y + size.y}, {from, v}, {to, v + 0.5f});
}

void draw_wipe(PanelContext& c, const ImVec2& at, const ImVec2& size) {
    IntegratorsView& view = c.ui.integrators;
    ImGui::InvisibleButton("wipe", size);
    c.ui.probe.record_last_item(fmt::format("Integrators/Wipe/{}", c.integrators ? "Image" : "No image"));
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive()) view.wipe = std::clamp((ImGui::GetIO().MousePos.x - at.x) / size.x, 0.f, 1.f);
    draw_half(c, at, size, 0, 0, view.wipe);
    draw_half(c, at, size, 1, view.wipe, 1);
    const float x = std::round(at.x + view.wipe * size.x);
    ImGui::GetWindowDrawList()->AddLine({x, at.y}, {x, at.y + size.y}, tone::text, std::max(1.f, ImGui::GetFontSize() / 10));
}

// The map with a frame and the percentage for each region that the bias test rejects.
void draw_difference(PanelContext& c, const IntegratorReport* report, const ImVec2& at, const ImVec2& size) {
    ImGui::Dummy(size);
    c.ui.probe.record_last_item(fmt::format("Integrators/Difference/{}", c.integrators ? "Image" : "No image"));
    if (!report || !c.integrators) return;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddImage(c.integrators, at, {at.x + size.x, at.y + size.y});
    const float sx = size.x / float(report->width), sy = size.y / float(report->height);
    const float font_size = std::round(ImGui::GetFontSize() * 0.8f);
    for (const RegionBias& region : report->verdict.regions) {
        if (!report->verdict.is_biased(region)) continue;
        const ImVec2 low{std::round(at.x + float(region.x) * sx), std::round(at.y + float(region.y) * sy)},
            high{std::round(at.x + float(region.x + region.width) * sx) - 1, std::round(at.y + float(region.y + region.height) * sy) - 1};
        draw.AddRect(low, high, tone::dim_text);
        const std::string text = fmt::format("{:+.{}f}", region.percent(), std::abs(region.percent()) < 9.95 ? 1 : 0);
        const ImVec2 extent = ImGui::GetFont()->CalcTextSizeA(font_size, FLT_MAX, 0, text.c_str());
        if (extent.x + 4 > high.x - low.x || extent.y > high.y - low.y) continue;
        draw.AddText(ImGui::GetFont(), font_size,
                     {std::round((low.x + high.x - extent.x) / 2), std::round((low.y + high.y - extent.y) / 2)}, tone::text, text.c_str());
    }
}

float aspect_of(const PanelContext& c, const IntegratorReport* report) {
    return report ? float(report->width) / float(report->height) : float(c.render_width) / float(std::max(1, c.render_height));
}

// Both images side by side under their names, or the one of wipe and difference; at most this high.
void draw_images(PanelContext& c, const IntegratorReport* report, float height) {
    const IntegratorsView& view = c.ui.integrators;
    const bool two = view.show == Show::images;
    const float gap = std::round(ImGui::GetFontSize() * 0.6f), aspect = aspect_of(c, report), room = ImGui::GetContentRegionAvail().x;
    const float column = std::max(1.f, two ? std::floor((room - gap) / 2) : room), left = ImGui::GetCursorPosX();
    if (two) height -= ImGui::GetTextLineHeightWithSpacing();
    const float width = std::max(1.f, std::floor(std::min(column, std::max(ImGui::GetFontSize() * least_image, height) * aspect)));
    const ImVec2 size{width, std::max(1.f, std::floor(width / aspect))};
    if (!two) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, tone::surround);
        return view.show == Show::wipe ? draw_wipe(c, at, size) : draw_difference(c, report, at, size);
    }
    for (int half = 0; half < 2; ++half) {
        const Column of = column_of(view, report, half == 1);
        if (half > 0) ImGui::SameLine(left + column + gap);
        ImGui::BeginGroup();
        draw_mark(of);
        text_line(c, of.name, tone::text, column - ImGui::GetFontSize());
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::Dummy(size);
        c.ui.probe.record_last_item(fmt::format("Integrators/{}/{}", of.record, c.integrators ? "Image" : "No image"));
        ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, tone::surround);
        draw_half(c, at, size, half);
        ImGui::EndGroup();
    }
}

// The numbers of both, one below the other.
void draw_figures(PanelContext& c, const IntegratorReport* report) {
    const float width = ImGui::GetContentRegionAvail().x;
    for (const bool biased : {false, true}) draw_numbers(c, column_of(c.ui.integrators, report, biased), width);
}

struct Texts {
    std::string verdict, bias, note;
};

Texts texts_of(const IntegratorReport* report, const IntegratorsView& view) {
    if (!report) return {"The first round is being rendered: records, probes or photons are made first.", "", ""};
    return {integrator_verdict(*report), integrator_bias_text(*report, view.integrator.kind, view.metric), integrator_note(*report)};
}

void draw_texts(PanelContext& c, const Texts& texts) {
    wrapped_text(texts.verdict);
    c.ui.probe.record_last_item("Integrators/Verdict/" + texts.verdict);
    tip_for_last_item(c.ui,
                      "The bias test compares the means of the image and of its regions with those of the path traced image; all tests "
                      "together err in 1 of 100 looks. What noise hides now may be found with more samples.");
    for (const std::string* text : {&texts.bias, &texts.note})
        if (!text->empty()) quiet_text(*text);
}

void draw_chart(PanelContext& c, const IntegratorReport* report, float height) {
    const IntegratorsView& view = c.ui.integrators;
    const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x, 1.f), height}, origin = ImGui::GetCursorScreenPos();
    const Plot plot = integrator_plot(report ? *report : IntegratorReport(), view.integrator.kind, view.metric);
    const ImFont& font = *ImGui::GetFont();
    const float em = ImGui::GetFontSize();
    draw_plot(*ImGui::GetWindowDrawList(), plot, compute_plot_layout(plot, plot_metrics(size, font, em, false)), origin, font, em,
              plot_tones_dark());
    ImGui::Dummy(size);
    for (size_t k = 0; k < 3; ++k)
        c.ui.probe.record_last_item(fmt::format("Integrators/Chart/{}/{} points", plot.curves[k].name, plot.curves[k].points.size()));
}

// Beside the choices where there is room.
void draw_knobs(PanelContext& c) {
    const auto knobs = integrator_knobs(c.ui.integrators.integrator);
    const float em = ImGui::GetFontSize(), width = 17 * em;
    for (size_t k = 0; k < knobs.size(); ++k) {
        same_line_if_fits(width, em);
        ImGui::PushID(int(k));
        ImGui::BeginChild("knob", {std::min(width, ImGui::GetContentRegionAvail().x), ImGui::GetFrameHeight()}, false,
                          ImGuiWindowFlags_NoScrollbar);
        {
            Fields f(c.ui, "Integrators");
            draw_integrator_knob(f, c.ui.integrators.integrator, knobs[k]);
        }
        ImGui::EndChild();
        ImGui::PopID();
    }
}

} // namespace

void draw_integrator_report(PanelContext& c, const IntegratorReport* report) {
    const float em = ImGui::GetFontSize(), gap = ImGui::GetStyle().ItemSpacing.x;
    draw_choices(c, c.ui.integrators);
    draw_knobs(c);
    const Texts texts = texts_of(report, c.ui.integrators);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    if (room.x < 2 * room.y || room.x < 40 * em) {
        draw_images(c, report, em * 24);
        draw_figures(c, report);
        draw_texts(c, texts);
        return draw_chart(c, report, std::max(ImGui::GetContentRegionAvail().y, em * 14));
    }
    // In a flat dock texts and chart are beside the images.
    ImGui::BeginChild("images", {std::floor(room.x * 0.36f), 0});
    draw_images(c, report, ImGui::GetContentRegionAvail().y);
    ImGui::EndChild();
    ImGui::SameLine(0, 2 * gap);
    ImGui::BeginChild("figures", {std::floor(room.x * 0.32f), 0});
    draw_figures(c, report);
    draw_texts(c, texts);
    ImGui::EndChild();
    ImGui::SameLine(0, 2 * gap);
    ImGui::BeginChild("chart", {0, 0});
    draw_chart(c, report, std::max(ImGui::GetContentRegionAvail().y, em * 8));
    ImGui::EndChild();
}

void draw_integrators_panel(PanelContext& c) {
    IntegratorsView& view = c.ui.integrators;
    if (const std::string& failure = measure_while_open(c, view, IntegratorWork::Input{c.scene(), lab_image_settings(c), view.integrator});
        !failure.empty())
        return quiet_text(failure);
    draw_integrator_report(c, view.state.output.get());
}

} // namespace blush
