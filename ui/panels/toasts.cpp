// Toasts and background jobs: small cards above the status bar.
#include "ui/panels/panels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <algorithm>

namespace blush {
namespace {

constexpr ImGuiWindowFlags card_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                        ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize;

void begin_card(const char* id, float right, float bottom, ImU32 edge) {
    ImGui::SetNextWindowPos({right, bottom}, ImGuiCond_Always, {1, 1});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.13f, 0.13f, 0.13f, 0.97f));
    ImGui::PushStyleColor(ImGuiCol_Border, edge);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ImGui::GetFontSize() / 4);
    ImGui::Begin(id, nullptr, card_flags);
}

// Returns the card's upper edge.
float end_card(PanelContext& c, const std::string& name) {
    const ImVec2 at = ImGui::GetWindowPos();
    c.ui.probe.record("Card/" + name, {at.x, at.y, ImGui::GetWindowWidth(), ImGui::GetWindowHeight()});
    ImGui::End();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor(2);
    return at.y;
}

ImU32 edge_of(Toast::Kind kind) {
    return kind == Toast::Kind::failure ? tone::failure : kind == Toast::Kind::warning ? tone::warning : IM_COL32(90, 90, 90, 255);
}

// Maximum width of a card: it must not cover a small image completely.
float text_width(const Region& viewport) {
    const float em = ImGui::GetFontSize();
    return std::clamp(viewport.width - 4 * em, 12 * em, 28 * em);
}

void draw_texts(const Toast& toast, float width) {
    ImGui::PushTextWrapPos(width);
    ImGui::TextUnformatted(toast.text.c_str());
    if (!toast.details.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
        ImGui::TextUnformatted(toast.details.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::PopTextWrapPos();
}

// Each draws cards from `bottom` upwards and sets `bottom` to the upper edge of the last one.
bool draw_job(PanelContext& c, const RunningJob& job, float right, float width, float& bottom) {
    const float em = ImGui::GetFontSize();
    begin_card("##job", right, bottom, IM_COL32(90, 90, 90, 255));
    elided_text(c.ui, job.title, tone::text, width);
    ImGui::ProgressBar(float(job.fraction), {std::min(em * 18, width - em * 5), em / 2}, "");
    bool cancelled = false;
    if (job.can_cancel) {
        ImGui::SameLine();
        cancelled = ImGui::SmallButton("Cancel");
        c.ui.probe.record_last_item("Job/Cancel");
    }
    if (!job.what.empty()) elided_text(c.ui, job.what, tone::dim_text, width);
    bottom = end_card(c, "job") - em / 2;
    return cancelled;
}

void draw_toasts(PanelContext& c, float right, float width, float& bottom) {
    const auto now = std::chrono::steady_clock::now();
    c.ui.toasts.remove_expired(now);
    std::optional<size_t> dismissed;
    const std::vector<Toast>& toasts = c.ui.toasts.all();
    for (size_t i = toasts.size(); i-- > 0;) {
        const Toast& toast = toasts[i];
        const std::chrono::duration<double> left = toast.since + lifetime(toast) - now;
        c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, std::max(left.count(), 0.0));
        begin_card(("##toast" + std::to_string(i)).c_str(), right, bottom, edge_of(toast.kind));
        draw_texts(toast, width);
        if (toast.action && ImGui::Button(shortcut(*toast.action).name)) {
            c.ui.commands.push_back(*toast.action);
            dismissed = i;
        }
        if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsAnyItemHovered()) dismissed = i;
        bottom = end_card(c, std::to_string(i)) - ImGui::GetFontSize() / 2;
    }
    if (dismissed) c.ui.toasts.dismiss(*dismissed);
}

} // namespace

bool draw_cards(PanelContext& c, const Region& viewport, const RunningJob* job) {
    const float em = ImGui::GetFontSize(), right = viewport.x + viewport.width - em;
    float bottom = viewport.y + viewport.height - em;
    const bool cancelled = job && draw_job(c, *job, right, text_width(viewport), bottom);
    draw_toasts(c, right, text_width(viewport), bottom);
    return cancelled;
}

} // namespace blush
