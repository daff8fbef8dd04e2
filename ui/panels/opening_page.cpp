// What a start without a scene offers: the demos and the files that were open last. It goes with Esc, a click beside it, or a file.
#include "ui/panels/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace blush {
namespace {

constexpr size_t max_cards = 5;
constexpr float card_width = 10, card_height = 6.25f; // ems

// A picture with the file's name below; true if it is clicked.
bool draw_card(PanelContext& c, const std::string& file, ImTextureID picture) {
    const float em = ImGui::GetFontSize();
    const std::string name = std::filesystem::path(file).stem().string();
    const ImVec2 low = ImGui::GetCursorScreenPos(), high{low.x + card_width * em, low.y + card_height * em};
    ImGui::PushID(file.c_str());
    const bool clicked = ImGui::InvisibleButton("card", {card_width * em, (card_height + 1.5f) * em});
    c.ui.probe.record_last_item("Opening/" + name);
    tip_for_last_item(c.ui, file.c_str());
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(low, high, tone::surround);
    if (picture) draw.AddImage(picture, low, high);
    if (ImGui::IsItemHovered()) draw.AddRect(low, high, tone::text);
    const ImVec4 clip{low.x, high.y, high.x, high.y + 1.5f * em};
    draw.AddText(ImGui::GetFont(), em, {low.x, high.y + 0.25f * em}, tone::text, name.c_str(), nullptr, 0, &clip);
    ImGui::PopID();
    return clicked;
}

void draw_cards(PanelContext& c, const char* title, const std::vector<std::string>& files, size_t in_row,
                const std::function<ImTextureID(const std::string&)>& picture) {
    if (files.empty()) return;
    ImGui::PushFont(heading_font());
    ImGui::TextUnformatted(title);
    ImGui::PopFont();
    for (size_t i = 0; i < std::min(files.size(), max_cards); ++i) {
        if (i % in_row > 0) ImGui::SameLine();
        if (draw_card(c, files[i], picture(files[i]))) c.ui.files.push_back({FileRequest::Use::open, files[i]});
    }
    ImGui::Spacing();
}

} // namespace

void draw_opening_page(PanelContext& c, const Region& viewport, const std::function<ImTextureID(const std::string&)>& picture) {
    if (!c.ui.opening_page || c.ui.question) return;
    // Over the picture alone: panels stay as they are. As many cards side by side as fit.
    ImGui::SetNextWindowPos({viewport.x + viewport.width / 2, viewport.y + viewport.height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    const ImGuiStyle& style = ImGui::GetStyle();
    const float card = card_width * ImGui::GetFontSize() + style.ItemSpacing.x;
    const size_t in_row = size_t(std::clamp((viewport.width - 2 * style.WindowPadding.x) / card, 1.f, float(max_cards)));
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                       ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
    ImGui::Begin("##opening", nullptr, flags);
    if (ImGui::IsWindowAppearing()) c.ui.next_frame_in = 0; // it is seen in the frame after the one that measures it
    draw_cards(c, "Demos", c.ui.demos, in_row, picture);
    std::vector<std::string> recent;
    std::ranges::copy_if(c.ui.settings.recent, std::back_inserter(recent), [&](const std::string& file) { return std::ranges::count(c.ui.demos, file) == 0; });
    draw_cards(c, "Recent", recent, in_row, picture);
    if (ImGui::Button("Open...")) c.ui.commands.push_back(Command::open);
    c.ui.probe.record_last_item("Opening/Open...");
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("or drop a file. Esc closes this page.");
    const bool beside = ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    ImGui::End();
    if (beside || !c.ui.files.empty()) c.ui.opening_page = false;
}

} // namespace blush
