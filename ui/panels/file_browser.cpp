// File browser: folders and the files with fitting extensions; by mouse, by keyboard or by a typed path.
#include "ui/gl/icons.h"
#include "ui/panels/panels.h"
#include "ui/snapshots/snapshots_view.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/guide_mark.h"
#include "ui/widgets/tooltip.h"
#include "ui/window/file_listing.h"
#include "ui/window/file_places.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui_internal.h> // ends the edit of the path
#include <imgui_stdlib.h>
#include <iterator>
#include <optional>
#include <utility>

namespace blush {
namespace {

using Use = FileRequest::Use;

// The typed file name of a save dialog is kept when the folder changes.
void enter(FileBrowser& b, const std::filesystem::path& folder) {
    const bool named = b.use == Use::save_scene && !b.typed.empty();
    b.typed = named ? (folder / std::filesystem::path(b.typed).filename()).string() : folder.string();
    b.folder = folder;
    b.chosen.clear();
}

void finish(PanelContext& c, const std::filesystem::path& path) {
    c.ui.files.push_back({c.ui.browser->use, path});
    c.ui.settings.browser_folder = c.ui.browser->folder.string();
    c.ui.browser.reset();
    ImGui::CloseCurrentPopup();
}

// Opens a typed folder, or accepts a typed file.
void take_typed(PanelContext& c) {
    FileBrowser& b = *c.ui.browser;
    std::error_code unreadable;
    const std::filesystem::path path = absolute_path(b.typed, b.folder);
    if (std::filesystem::is_directory(path, unreadable))
        enter(b, path);
    else if (b.use == Use::save_scene && std::filesystem::is_directory(path.parent_path(), unreadable))
        finish(c, matches(scene_files, path) ? path : std::filesystem::path(path.string() + ".gltf"));
    else if (std::filesystem::is_regular_file(path, unreadable) && b.use != Use::snapshot_folder)
        finish(c, path);
    else
        c.ui.toasts.fail((b.use == Use::snapshot_folder ? "Folder not found: " : "File not found: ") + b.typed);
}

// Accepts the typed folder, which is the shown one until another is typed.
void use_typed_folder(PanelContext& c) {
    const FileBrowser& b = *c.ui.browser;
    std::error_code unreadable;
    const std::filesystem::path path = absolute_path(b.typed, b.folder);
    std::filesystem::is_directory(path, unreadable) ? finish(c, path) : take_typed(c);
}

// Opens the selected file or folder.
void take_chosen(PanelContext& c) {
    FileBrowser& b = *c.ui.browser;
    std::error_code unreadable;
    const std::filesystem::path path = b.folder / b.chosen;
    if (std::filesystem::is_directory(path, unreadable))
        enter(b, path);
    else if (b.use == Use::save_scene)
        take_typed(c);
    else
        finish(c, path);
}

void choose(FileBrowser& b, const FileEntry& entry) {
    b.chosen = entry.name;
    if (!entry.folder || b.use != Use::save_scene) b.typed = (b.folder / entry.name).string(); // the name of the file to save is kept
}

// Up and Down select in the list, from the path field as well.
void choose_by_arrows(FileBrowser& b, const std::vector<FileEntry>& entries) {
    const int step = int(ImGui::IsKeyPressed(key::down)) - int(ImGui::IsKeyPressed(key::up));
    if (step == 0 || entries.empty()) return;
    const auto at = std::ranges::find(entries, b.chosen, &FileEntry::name);
    const ptrdiff_t last = std::ssize(entries) - 1;
    const ptrdiff_t next = at == entries.end() ? (step > 0 ? 0 : last) : std::clamp(at - entries.begin() + step, ptrdiff_t(0), last);
    ImGui::ClearActiveID(); // Enter now opens the selected entry
    choose(b, entries[size_t(next)]);
    b.scroll_to_chosen = true;
}

bool enter_opens_chosen(const FileBrowser& b) {
    const bool pressed = ImGui::IsKeyPressed(key::enter, false) || ImGui::IsKeyPressed(key::pad_enter, false);
    return pressed && !ImGui::GetIO().WantTextInput && !b.chosen.empty();
}

// Tab completes the path.
int complete(ImGuiInputTextCallbackData* data) {
    const FileBrowser& b = *static_cast<const FileBrowser*>(data->UserData);
    const std::string completed = completed_path(absolute_path({data->Buf, size_t(data->BufTextLen)}, b.folder).string(), filter_of(b.use));
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, completed.c_str());
    return 0;
}

void draw_path_row(PanelContext& c) {
    FileBrowser& b = *c.ui.browser;
    if (icon_button("up", Icon::arrow_up, tone::dim_text) && b.folder.has_parent_path()) enter(b, b.folder.parent_path());
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (b.just_opened) ImGui::SetKeyboardFocusHere();
    b.just_opened = false;
    constexpr ImGuiInputTextFlags flags = ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackCompletion;
    if (elided_path_input(c.ui, "##path", b.typed, flags, complete, &b)) take_typed(c);
    if (c.ui.browser) c.ui.probe.record_last_item("Browser/Path");
}

void draw_bookmark_button(PanelContext& c) {
    const std::string folder = c.ui.browser->folder.string();
    std::vector<std::string>& bookmarks = c.ui.settings.bookmarks;
    const bool kept = std::ranges::count(bookmarks, folder) > 0;
    if (ImGui::Button(kept ? "Remove bookmark" : "Bookmark", {-FLT_MIN, 0})) {
        if (kept)
            std::erase(bookmarks, folder);
        else
            bookmarks.push_back(folder);
    }
    c.ui.probe.record_last_item("Browser/Bookmark");
    tip_for_last_item(c.ui, "Add this folder to the list of places.");
}

void draw_places(PanelContext& c, float width, float height) {
    ImGui::BeginChild("places", {width, height}, true);
    std::optional<std::filesystem::path> entered;
    int id = 0;
    for (const FilePlace& place : file_places(c.ui.settings, c.ui.browser->scene_folder)) {
        ImGui::PushID(id++);
        const std::string name = elided(place.name, ImGui::GetContentRegionAvail().x) + "###place";
        if (ImGui::Selectable(name.c_str(), place.folder == c.ui.browser->folder, ImGuiSelectableFlags_DontClosePopups))
            entered = place.folder;
        c.ui.probe.record_last_item("Browser/Place/" + place.name);
        tip_for_last_item(c.ui, place.folder.string().c_str());
        ImGui::PopID();
    }
    ImGui::Spacing();
    draw_bookmark_button(c);
    ImGui::EndChild();
    if (entered) enter(*c.ui.browser, *entered);
}

// A thumbnail for a visible file that has one, else an icon.
void draw_entry_image(PanelContext& c, const FileEntry& entry, float height) {
    const float width = height * Thumbnail::width / Thumbnail::height;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImTextureID image = {};
    if (!entry.folder && c.file_thumbnail && ImGui::IsRectVisible({width, height}))
        image = c.file_thumbnail((c.ui.browser->folder / entry.name).string());
    if (image) {
        ImGui::Image(image, {width, height});
        c.ui.probe.record_last_item("Browser/Thumbnail/" + entry.name);
        return;
    }
    ImGui::Dummy({width, height});
    const float size = ImGui::GetTextLineHeight();
    draw_icon(*ImGui::GetWindowDrawList(), entry.folder ? Icon::folder : Icon::file, {at.x + width / 2, at.y + height / 2}, size,
              tone::dim_text);
}

void draw_entry(PanelContext& c, const FileEntry& entry) {
    FileBrowser& b = *c.ui.browser;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const ExtensionFilter& filter = filter_of(b.use);
    const bool imaged = filter != table_files && filter != photometric_files;
    const float height = ImGui::GetTextLineHeight() * (imaged && !entry.folder ? 2.4f : 1.f);
    draw_entry_image(c, entry, height);
    ImGui::SameLine();
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, {0, 0.5f});
    const std::string shown = elided_middle(entry.name, ImGui::GetContentRegionAvail().x);
    const bool clicked = ImGui::Selectable(
        (shown + "###" + entry.name).c_str(), b.chosen == entry.name,
        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups, {0, height});
    ImGui::PopStyleVar();
    c.ui.probe.record_last_item("Browser/" + entry.name);
    if (shown != entry.name) tip_for_last_item(c.ui, entry.name.c_str());
    const bool twice = clicked && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    if (b.chosen == entry.name && std::exchange(b.scroll_to_chosen, false)) ImGui::SetScrollHereY();
    if (clicked && !entry.folder) choose(b, entry);
    ImGui::TableNextColumn();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + (height - ImGui::GetTextLineHeight()) / 2);
    if (!entry.folder) ImGui::TextDisabled("%s", bytes_text(entry.bytes).c_str());
    if (clicked && entry.folder)
        enter(b, b.folder / entry.name);
    else if (twice)
        finish(c, b.folder / entry.name);
}

void draw_list(PanelContext& c, float height) {
    const auto list = list_folder(c.ui.browser->folder, filter_of(c.ui.browser->use));
    if (list) choose_by_arrows(*c.ui.browser, list->entries);
    ImGui::BeginChild("list", {0, height}, true);
    if (!list)
        ImGui::TextWrapped("%s", list.error().text().c_str());
    else if (list->entries.empty())
        ImGui::TextDisabled("No matching files in this folder.");
    else if (ImGui::BeginTable("entries", 2, ImGuiTableFlags_RowBg)) {
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize() * 5);
        for (const FileEntry& entry : list->entries) {
            if (c.ui.browser) draw_entry(c, entry); // until one was accepted
        }
        ImGui::EndTable();
    }
    if (list && list->left_out > 0) {
        ImGui::TextDisabled(
            "%s",
            fmt::format("{} of other types hidden", list->left_out == 1 ? "1 file" : fmt::format("{} files", list->left_out)).c_str());
        if (c.ui.browser) c.ui.probe.record_last_item("Browser/Left out");
    }
    ImGui::EndChild();
}

void draw_buttons(PanelContext& c) {
    const FileBrowser& b = *c.ui.browser;
    const float width = ImGui::GetFontSize() * 7;
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2 * width - ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button("Cancel", {width, 0})) {
        c.ui.browser.reset();
        ImGui::CloseCurrentPopup();
        return;
    }
    ImGui::SameLine();
    if (b.use == Use::save_scene) {
        std::error_code unreadable;
        if (ImGui::Button(std::filesystem::is_regular_file(absolute_path(b.typed, b.folder), unreadable) ? "Replace" : "Save", {width, 0}))
            take_typed(c);
    } else {
        const bool folder = b.use == Use::snapshot_folder;
        ImGui::BeginDisabled(!folder && b.typed == b.folder.string());
        if (ImGui::Button(folder ? "Use this folder" : "Open", {width, 0})) folder ? use_typed_folder(c) : take_typed(c);
        ImGui::EndDisabled();
    }
    if (c.ui.browser) c.ui.probe.record_last_item("Browser/OK");
}

} // namespace

void draw_file_browser(PanelContext& c) {
    if (!c.ui.browser || c.ui.browser->on_desktop) return;
    const std::string title = std::string(title_of(c.ui.browser->use)) + "###browser";
    const char* const name = title.c_str();
    if (c.ui.browser->just_opened) {
        if (c.ui.browser->typed.empty()) enter(*c.ui.browser, c.ui.browser->folder);
        ImGui::OpenPopup(name);
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(em * 44, screen.x * 0.9f), std::min(em * 32, screen.y * 0.85f)}, ImGuiCond_Appearing);
    bool open = true;
    if (ImGui::BeginPopupModal(name, &open, ImGuiWindowFlags_NoCollapse)) {
        guide_mark_in_title_bar(c.ui, "Guide/File browser", guide_page::file_browser);
        draw_path_row(c);
        const float below = ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().ItemSpacing.y;
        const float height = ImGui::GetContentRegionAvail().y - below;
        if (c.ui.browser) draw_places(c, em * 9, height);
        ImGui::SameLine();
        if (c.ui.browser) draw_list(c, height);
        if (c.ui.browser && enter_opens_chosen(*c.ui.browser)) take_chosen(c);
        if (c.ui.browser) draw_buttons(c);
        if (c.ui.browser && ImGui::IsKeyPressed(key::escape)) {
            c.ui.browser.reset();
            ImGui::CloseCurrentPopup();
        }
        ImGui::EndPopup();
    }
    if (!open) c.ui.browser.reset();
}

} // namespace blush
