// Status bar: progress, speed and estimated error of the render, and the kernel in use.
#include "core/text.h"
#include "ui/panels/panels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/guide_mark.h"
#include "ui/widgets/tooltip.h"
#include "ui/window/theme.h"
#include "ui/window/time_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

const char* state_name(SessionStatus::State state) {
    switch (state) {
    case SessionStatus::State::idle: return "Idle";
    case SessionStatus::State::updating: return "Updating";
    case SessionStatus::State::rendering: return "Rendering";
    case SessionStatus::State::yielding: return "Mixing";
    case SessionStatus::State::paused: return "Paused";
    case SessionStatus::State::complete: return "Complete";
    case SessionStatus::State::failed: return "Failed";
    }
    return "";
}

std::string rate_text(double rate) {
    return rate >= 100  ? fmt::format("{:.0f} spp/s", rate)
           : rate >= 10 ? fmt::format("{:.1f} spp/s", rate)
                        : fmt::format("{:.2f} spp/s", rate);
}

// Fixed minimum width, so that cells do not move when numbers change. If the bar is too narrow, cells of low weight are dropped.
struct Cell {
    float width; // font sizes, minimum
    std::string text, tip;
    ImU32 color = tone::text;
    int weight = 5;
};
using Cells = std::vector<Cell>;

float width_of(const Cell& cell) {
    const float em = ImGui::GetFontSize();
    return std::max(cell.width * em, ImGui::CalcTextSize(cell.text.c_str()).x + em);
}

// The cells that fit into the width, by weight.
Cells fitting(Cells cells, float width) {
    const auto total = [&] {
        float sum = 0;
        for (const Cell& cell : cells) sum += width_of(cell);
        return sum;
    };
    while (cells.size() > 1 && total() > width) cells.erase(std::ranges::min_element(cells, {}, &Cell::weight));
    return cells;
}

void draw(PanelContext& c, const Cells& cells, float x) {
    for (const Cell& cell : cells) {
        ImGui::SameLine(x);
        ImGui::PushStyleColor(ImGuiCol_Text, cell.color);
        ImGui::TextUnformatted(cell.text.c_str());
        ImGui::PopStyleColor();
        if (cell.color == tone::warning) c.ui.probe.record_last_item("Status/" + cell.text);
        tip_for_last_item(c.ui, cell.tip.c_str());
        x += width_of(cell);
    }
}

// Progress bar along the upper edge: towards the nearest stop rule. Full only when the rule is met.
void draw_progress_line(double progress) {
    const ImVec2 low = ImGui::GetWindowPos();
    const float width = ImGui::GetWindowWidth(), height = std::max(2.f, ImGui::GetFontSize() / 8);
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + std::floor(width * float(progress)), low.y + height}, tone::field_filled);
}

// Which image is shown. The error cell always refers to the raw image; the change of energy refers to the denoiser.
void add_denoised_cells(const PanelContext& c, Cells& cells, const Frame& frame) {
    const DenoiseView& view = c.ui.denoise;
    if (!view.wants_denoised()) return cells.push_back({4, "raw", "The raw image is shown, without denoising.", tone::dim_text, 6});
    const DenoisedImage* denoised = c.denoised.get();
    cells.push_back(
        {19, shown_text(view, frame, denoised),
         "The displayed image, and how far the denoised one is behind the raw one. Fast and base quality are for images that still change; "
         "the complete image gets the high one. While the camera moves, parts of the view before are shown; they are never measured or "
         "saved.",
         tone::text, 7});
    if (!denoised) return;
    cells.push_back({9, fmt::format("energy {} %", signed_number(energy_change_percent(denoised->denoised), 2)),
                     "Change of the mean luminance by the denoiser. The estimated error is that of the raw image.", tone::text, 3});
}

Cell error_cell(const Frame& frame) {
    const ErrorEstimate& e = frame.error;
    if (e.misses_highlights && !e.known)
        return {12, "error: highlights missing?",
                "Lamps in mirrors or glass make highlights that are too small for the samples so far. Some may be missing from the image, "
                "so its error is not known. More samples or a larger image find them.",
                tone::warning, 8};
    if (!e.known) return {9, "error not known yet", "Not enough samples yet to estimate the error.", tone::text, 8};
    const bool older = frame.error_samples < frame.samples;
    const std::string of = older ? fmt::format("the image as it was after {} samples per pixel", frame.error_samples) : "the image";
    return {older ? 14.f : 9.f,
            fmt::format("error {:.3g} %", 100 * std::sqrt(e.relmse)) + (older ? fmt::format(" at {} spp", frame.error_samples) : ""),
            fmt::format(
                "Estimated relative error (root of relMSE) of {}, from two independent halves of the samples. relMSE {:.3g}, 95 % interval "
                "{:.3g} to {:.3g}.{}",
                of, e.relmse, e.low, e.high,
                e.misses_highlights ? " Small highlights of lamps in mirrors or glass may be missing; the interval allows for them." : ""),
            tone::text, 8};
}

void add_frame_cells(const PanelContext& c, Cells& cells, const Frame& frame) {
    const int64_t target = c.project().render.spp;
    cells.push_back({9, target > 0 ? fmt::format("{} / {} spp", frame.samples, target) : fmt::format("{} spp", frame.samples),
                     "Samples (paths) per pixel: rendered, and the target.", tone::text, 9});
    cells.push_back({6.5f, rate_text(frame.samples_per_second), "Samples per pixel per second, in the last batch.", tone::text, 4});
    const bool mix_is_new = c.mixing && c.mixing->gains != frame.gains;
    if (mix_is_new)
        cells.push_back({9, "error pending",
                         "The light mix is shown immediately. Its error is estimated with the next frame of the render thread.",
                         tone::dim_text, 8});
    else
        cells.push_back(error_cell(frame));
    if (!frame.missing_light.empty())
        cells.push_back({14, "some light cannot be found", frame.missing_light + ". It is not in the estimated error.", tone::warning, 8});
    add_denoised_cells(c, cells, frame);
    cells.push_back({6, elapsed_text(frame.seconds), "Time spent rendering since the last edit.", tone::text, 4});
    cells.push_back({8.5f,
                     frame.divider > 1 ? fmt::format("{} × {}  1/{}", frame.width, frame.height, frame.divider)
                                       : fmt::format("{} × {}", frame.width, frame.height),
                     "Rendered resolution. It is lower just after an edit, for a fast response.", tone::text, 3});
    cells.push_back({9, frame.kernel, "The render kernel: instruction set / features that the scene needs.", tone::dim_text, 1});
    if (frame.health.dropped() > 0)
        cells.push_back({12, fmt::format("{} invalid samples dropped", frame.health.dropped()),
                         "Samples that were NaN, infinite or negative. They are excluded from the image. See the Health panel.",
                         tone::warning, 7});
}

// Empty if exposure is 0 and not metered.
std::string exposure_text(const PanelContext& c) {
    const float exposure = c.shown_view().exposure_ev;
    const bool metered = c.project().view.auto_exposure != AutoExposure::off;
    return exposure == 0 && !metered ? "" : fmt::format("{}{} EV", metered ? "auto " : "", signed_number(exposure, 2));
}

} // namespace

void draw_status_bar(PanelContext& c) {
    draw_progress_line(c.status.progress);
    const bool failed = c.status.state == SessionStatus::State::failed;
    const float left = ImGui::GetStyle().WindowPadding.x, width = ImGui::GetWindowWidth();
    ImGui::SetCursorPos({left, (ImGui::GetWindowHeight() - ImGui::GetTextLineHeight()) / 2});
    ImGui::Dummy({0, 0});
    Cells cells{{6, state_name(c.status.state),
                 "State of the render thread. It sleeps when complete and waits while the light mix is edited.",
                 failed ? tone::failure : tone::text, 10}};
    if (!failed && c.frame) add_frame_cells(c, cells, *c.frame);
    if (c.ui.zoom.scale > 0)
        cells.push_back({5, fmt::format("{:.0f} %", 100 * c.ui.zoom.scale), "Zoom: screen pixels per image pixel. Z switches back to fit.",
                         tone::dim_text, 5});
    if (const FarmPlan* plan = c.ui.farm.running())
        cells.push_back({12, "farm: " + progress_text(*plan), plan->folder.filename().string() + ": a plan that runs. See the Farm panel.",
                         tone::text, 6});
    const std::string exposure = exposure_text(c);
    const float right = width - guide_mark_width() - (exposure.empty() ? 0 : left + ImGui::CalcTextSize(exposure.c_str()).x);
    if (failed)
        cells.push_back({30, elided(c.status.message, right - left - 8 * ImGui::GetFontSize()), c.status.message, tone::failure, 9});
    draw(c, fitting(std::move(cells), right - left), left);
    if (!exposure.empty()) draw(c, {{0, exposure, "Exposure of the display.", tone::dim_text, 0}}, right);
    ImGui::SetCursorPos({width - guide_mark_width(), 0});
    guide_mark(c.ui, "Guide/Status bar", guide_page::status_bar, ImGui::GetWindowHeight());
}

} // namespace blush
