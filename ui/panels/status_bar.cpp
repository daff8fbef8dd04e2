// Status bar: how far the picture is, how fast it gets there, and what makes it.
#include "core/text.h"
#include "ui/time_text.h"
#include "ui/panels/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

const char* state_name(SessionStatus::State state) {
    switch (state) {
    case SessionStatus::State::idle: return "Idle";
    case SessionStatus::State::updating: return "Updating";
    case SessionStatus::State::rendering: return "Rendering";
    case SessionStatus::State::aside: return "Mixing";
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

// Each cell keeps its place while its number changes.
void cell(PanelContext& c, float& x, float width, const std::string& text, const char* tip, ImU32 color = tone::text) {
    ImGui::SameLine(x);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    tip_for_last_item(c.ui, tip);
    x += width * ImGui::GetFontSize();
}

// Along the upper edge: the way to the nearest stop rule. Full only when it is reached.
void draw_progress_line(double progress) {
    const ImVec2 low = ImGui::GetWindowPos();
    const float width = ImGui::GetWindowWidth(), height = std::max(2.f, ImGui::GetFontSize() / 8);
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + std::floor(width * float(progress)), low.y + height}, tone::field_filled);
}

// Which picture is looked at. The error before it is the raw one's in any case; what the denoiser did to the picture stands beside it.
void draw_denoised_cells(PanelContext& c, float& x, const Frame& frame) {
    const DenoiseView& view = c.ui.denoise;
    if (!view.wants_denoised()) return cell(c, x, 4, "raw", "The image is shown as it was traced.", tone::dim_text);
    const DenoisedPicture* denoised = c.denoised.get();
    cell(c, x, 19, shown_text(view, frame, denoised), "What is shown, and by how much the denoised picture is older than the raw one.");
    if (!denoised) return;
    cell(c, x, 9, fmt::format("energy {} %", signed_number(energy_change_percent(denoised->denoised), 2)),
         "By how much the denoiser changed the mean luminance of the picture. The estimated error is that of the raw image.");
}

void draw_error_cell(PanelContext& c, float& x, const Frame& frame) {
    const ErrorEstimate& e = frame.error;
    if (!e.known)
        return cell(c, x, 9, "error not known yet", "The error is estimated from two independent halves of the samples, now and then, so that this takes "
                                                    "hardly any time. The samples so far do not tell.");
    const bool older = frame.error_samples < frame.samples;
    const std::string of = older ? fmt::format("the picture as it was after {} samples per pixel", frame.error_samples) : "the picture";
    cell(c, x, older ? 14 : 9, fmt::format("error {:.3g} %", 100 * std::sqrt(e.relmse)) + (older ? fmt::format(" at {} spp", frame.error_samples) : ""),
         fmt::format("Estimated relative error (root of relMSE) of {}, from two independent halves of the samples. relMSE {:.3g}, 95 % interval "
                     "{:.3g} to {:.3g}.",
                     of, e.relmse, e.low, e.high)
             .c_str());
}

void draw_frame_cells(PanelContext& c, float& x, const Frame& frame) {
    const int64_t target = c.project().render.spp;
    cell(c, x, 9, target > 0 ? fmt::format("{} / {} spp", frame.samples, target) : fmt::format("{} spp", frame.samples),
         "Samples, that is paths, per pixel so far and in the end.");
    cell(c, x, 6.5f, rate_text(frame.samples_per_second), "Samples per pixel and second, over the last batch.");
    const bool mix_is_new = c.mixing && c.mixing->gains != frame.gains;
    if (mix_is_new)
        cell(c, x, 9, "error follows", "The mix of lights shows at once; its error is estimated with the next picture of the session.", tone::dim_text);
    else
        draw_error_cell(c, x, frame);
    if (!frame.missing_light.empty())
        cell(c, x, 14, "some light cannot be found", (frame.missing_light + ". It is not in the estimated error.").c_str(), tone::warning);
    draw_denoised_cells(c, x, frame);
    cell(c, x, 6, elapsed_text(frame.seconds), "Time spent rendering since the last edit.");
    cell(c, x, 8.5f,
         frame.divider > 1 ? fmt::format("{} × {}  1/{}", frame.width, frame.height, frame.divider)
                           : fmt::format("{} × {}", frame.width, frame.height),
         "Pixels rendered. Right after an edit they are fewer, so that the picture comes at once.");
    cell(c, x, 9, frame.kernel, "Which of the compiled kernels renders: instruction set / what the scene needs.", tone::dim_text);
    if (frame.health.dropped() > 0)
        cell(c, x, 12, fmt::format("{} bad samples dropped", frame.health.dropped()),
             "Samples that were not a number, infinite or negative. They are left out of the picture and counted.", tone::warning);
}

} // namespace

void draw_status_bar(PanelContext& c) {
    draw_progress_line(c.status.progress);
    const bool failed = c.status.state == SessionStatus::State::failed;
    float x = ImGui::GetStyle().WindowPadding.x;
    ImGui::SetCursorPos({x, (ImGui::GetWindowHeight() - ImGui::GetTextLineHeight()) / 2});
    ImGui::Dummy({0, 0});
    cell(c, x, 6, state_name(c.status.state), "What the render thread does. Complete, it sleeps; while lights are being mixed it stands still.", failed ? tone::failure : tone::text);
    if (failed)
        cell(c, x, 30, c.status.message, "", tone::failure);
    else if (c.frame)
        draw_frame_cells(c, x, *c.frame);
    if (c.ui.zoom.scale > 0)
        cell(c, x, 5, fmt::format("{:.0f} %", 100 * c.ui.zoom.scale),
             "Pixels of the screen for one of the picture. Z shows all of it again.", tone::dim_text);
    const float exposure = c.shown_view().exposure_ev;
    const bool metered = c.project().view.auto_exposure != AutoExposure::off;
    if (exposure != 0 || metered) {
        const std::string text = fmt::format("{}{} EV", metered ? "auto " : "", signed_number(exposure, 2));
        x = std::max(x, ImGui::GetWindowWidth() - ImGui::CalcTextSize(text.c_str()).x - ImGui::GetStyle().WindowPadding.x);
        cell(c, x, 0, text, "Exposure of the display.", tone::dim_text);
    }
}

} // namespace blush
