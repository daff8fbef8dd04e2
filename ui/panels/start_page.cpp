// Start page in a dock below the image: demos and recent files. It closes with Esc, or when a file is opened.
#include "ui/panels/panels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace blush {
namespace {

constexpr size_t max_cards = 10;
constexpr float card_width = 7, card_height = 4.4f, title_width = 4.5f; // ems

// A thumbnail with the file's name below. Returns true if it is clicked.
bool draw_card(PanelContext& c, const std::string& file) {
    const float em = ImGui::GetFontSize(), width = card_width * em;
    const std::string name = std::filesystem::path(file).stem().string();
    const ImVec2 low = ImGui::GetCursorScreenPos(), high{low.x + width, low.y + card_height * em};
    ImGui::PushID(file.c_str());
    const bool clicked = ImGui::InvisibleButton("card", {width, (card_height + 1.4f) * em});
    c.ui.probe.record_last_item("Opening/" + name);
    tip_for_last_item(c.ui, file.c_str());
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(low, high, tone::surround);
    if (const ImTextureID image = c.file_thumbnail ? c.file_thumbnail(file) : ImTextureID{}) draw.AddImage(image, low, high);
    if (ImGui::IsItemHovered()) draw.AddRect(low, high, tone::text);
    draw.AddText({low.x, high.y + 0.2f * em}, tone::text, elided(name, width).c_str());
    ImGui::PopID();
    return clicked;
}

// Rows filled from the left; with `one_row`, files that do not fit are only in the menus.
void draw_rows(PanelContext& c, const char* title, const std::vector<std::string>& files, bool one_row) {
    if (files.empty()) return;
    const float em = ImGui::GetFontSize(), left = ImGui::GetCursorPosX();
    ImGui::TextUnformatted(title);
    ImGui::SameLine(left + title_width * em);
    const float card = card_width * em + ImGui::GetStyle().ItemSpacing.x;
    const size_t fitting = size_t(std::clamp(ImGui::GetContentRegionAvail().x / card, 1.f, float(max_cards)));
    for (size_t i = 0; i < (one_row ? std::min(files.size(), fitting) : files.size()); ++i) {
        if (i % fitting > 0)
            ImGui::SameLine();
        else if (i > 0)
            ImGui::SetCursorPosX(left + title_width * em);
        if (draw_card(c, files[i])) c.ui.files.push_back({FileRequest::Use::open, files[i]});
    }
}

} // namespace

void draw_start_page(PanelContext& c) {
    if (ImGui::Button("Open...")) c.ui.commands.push_back(Command::open);
    c.ui.probe.record_last_item("Opening/Open...");
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    quiet_text("or drop a file. Esc closes this page.");
    std::vector<std::string> recent;
    std::ranges::copy_if(c.ui.settings.recent, std::back_inserter(recent),
                         [&](const std::string& file) { return std::ranges::count(c.ui.demos, file) == 0; });
    draw_rows(c, "Recent", recent, true);
    draw_rows(c, "Demos", c.ui.demos, false);
    if (!c.ui.files.empty()) c.ui.opening_page = false;
}

} // namespace blush
