#include "ui/window/docks.h"

#include "ui/viewport/regions.h"
#include "ui/widgets/guide_mark.h"
#include "ui/widgets/tooltip.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <imgui_internal.h> // which window is moved by the mouse
#include <optional>
#include <utility>

namespace blush {
namespace {

using Ids = std::vector<std::string>;

Ids docked(const PanelContext& c, DockSide side, bool right_dock) { return tabs_on(c.ui.settings.dock, side, c.ui.docks.open, right_dock); }

DockTab& place_of(PanelContext& c, const Instrument& i) { return place_of(c.ui.settings.dock, i.id, i.side); }

void put(PanelContext& c, const Instrument& i, DockSide side) {
    DockTab& tab = place_of(c, i);
    tab.side = side;
    tab.floats = false;
    c.ui.docks.to_front.insert(i.id);
}

void tear_off(PanelContext& c, const Instrument& i, bool by_mouse) {
    place_of(c, i).floats = true;
    if (by_mouse) c.ui.docks.torn_off = i.id;
}

bool menu_item(PanelContext& c, const char* name) {
    const bool pressed = ImGui::MenuItem(name);
    c.ui.probe.record_last_item(std::string("Dock menu/") + name);
    return pressed;
}

// For the last item: a tab, or the title bar of a window.
void draw_menu(PanelContext& c, const Instrument& i) {
    if (!ImGui::BeginPopupContextItem(i.id)) return;
    const DockTab& tab = place_of(c, i);
    if ((tab.floats || tab.side == DockSide::bottom) && menu_item(c, "Dock on the right")) put(c, i, DockSide::right);
    if ((tab.floats || tab.side == DockSide::right) && menu_item(c, "Dock at the bottom")) put(c, i, DockSide::bottom);
    if (!tab.floats && menu_item(c, "Tear off")) tear_off(c, i, false);
    ImGui::Separator();
    if (menu_item(c, "Guide")) c.ui.guide_page = i.guide;
    if (menu_item(c, "Close")) i.set_open(c, false);
    ImGui::EndPopup();
}

void draw_inside(PanelContext& c, const Instrument& i) {
    ImGui::BeginChild(i.id, {0, 0}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    i.draw(c);
    ImGui::EndChild();
}

// True if the tab is dragged away from its row.
bool is_dragged_off(const Region& row) {
    const float away = ImGui::GetFontSize() * 2, y = ImGui::GetIO().MousePos.y;
    return ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left) && (y < row.y - away || y > row.y + row.height + away);
}

// Draws a tab and, if it is in front, its content. Returns the tab's rectangle; nullopt if it has no layout yet.
std::optional<float> draw_tab(PanelContext& c, const Instrument& i, DockSide side, const Region& region) {
    DockView& view = c.ui.docks;
    bool open = true;
    const bool asked = view.to_front.contains(i.id);
    const bool front = ImGui::BeginTabItem(i.title, &open, asked ? ImGuiTabItemFlags_SetSelected : 0);
    if (front) view.to_front.erase(i.id);
    if (asked && !front) c.ui.seconds_to_next_frame = 0; // it comes to the front in the next frame
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    c.ui.probe.record_last_item(std::string("Dock/") + i.title);
    if (is_dragged_off({region.x, low.y, region.width, high.y - low.y})) tear_off(c, i, true);
    draw_menu(c, i);
    tip_for_last_item(c.ui, "Drag along the row to reorder, or away from it to undock. Right-click to move it to the other side.");
    if (front) {
        view.in_sight.insert(i.id);
        c.ui.settings.dock.front[size_t(side)] = i.id;
        draw_inside(c, i);
        c.ui.probe.record(std::string("Docked/") + i.title, region);
        ImGui::EndTabItem();
    }
    if (!open) i.set_open(c, false);
    return high.x > low.x ? std::optional(low.x) : std::nullopt;
}

void draw_dock(PanelContext& c, std::span<const Instrument> instruments, DockSide side, const Region& region, const Ids& ids) {
    if (region.width <= 0 || region.height <= 0 || ids.empty()) return;
    begin_region(side == DockSide::right ? "Right dock" : "Bottom dock", region, {.padded = false});
    constexpr ImGuiTabBarFlags flags = ImGuiTabBarFlags_Reorderable | ImGuiTabBarFlags_FittingPolicyScroll | ImGuiTabBarFlags_NoTooltip;
    const ImVec2 corner{region.x + region.width - guide_mark_width(), ImGui::GetCursorScreenPos().y};
    float& tabs_end = ImGui::GetCurrentWindow()->WorkRect.Max.x;
    const float end = std::exchange(tabs_end, corner.x); // the tabs end before the mark, the content does not
    // A presentation has tabs of its own, so that those before it keep their order.
    const bool begun = ImGui::BeginTabBar(c.ui.presentation.on ? "presented tabs" : "tabs", flags);
    tabs_end = end;
    if (begun) {
        std::vector<std::pair<float, std::string>> places;
        for (const std::string& id : ids)
            if (const auto x = draw_tab(c, *find_instrument(instruments, id), side, region)) places.emplace_back(*x, id);
        ImGui::EndTabBar();
        if (const Instrument* const front = find_instrument(instruments, c.ui.settings.dock.front[size_t(side)])) {
            ImGui::SetCursorScreenPos(corner);
            guide_mark(c.ui, std::string("Dock guide/") + front->title, front->guide, ImGui::GetFrameHeight());
        }
        std::ranges::sort(places);
        Ids shown;
        for (const auto& [x, id] : places) shown.push_back(id);
        if (shown.size() == ids.size()) reorder(c.ui.settings.dock, shown);
    }
    end_region();
}

// The dock position for a window that is dropped here.
void show_target(const Layout& l, DockSide side) {
    const float edge = ImGui::GetFontSize() * 2;
    Region at = side == DockSide::right ? l.right_dock : l.bottom_dock;
    if (at.width <= 0 || at.height <= 0)
        at = side == DockSide::right ? Region{l.room.x + l.room.width - edge, l.room.y, edge, l.room.height}
                                     : Region{l.room.x, l.bottom_dock.y + l.bottom_dock.height - edge, l.room.width, edge};
    ImDrawList& draw = *ImGui::GetForegroundDrawList();
    draw.AddRectFilled({at.x, at.y}, {at.x + at.width, at.y + at.height}, IM_COL32(255, 255, 255, 28));
    draw.AddRect({at.x, at.y}, {at.x + at.width, at.y + at.height}, tone::text);
}

// While the mouse moves the window, and on release.
void follow_mouse(PanelContext& c, const Instrument& i, const Layout& l) {
    DockView& view = c.ui.docks;
    const ImGuiWindow* const moving = GImGui->MovingWindow;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const auto target = dock_at(l, mouse.x, mouse.y, ImGui::GetFontSize());
    if (moving && moving->RootWindow == ImGui::GetCurrentWindow()->RootWindow) {
        view.moved = i.id;
        if (target) show_target(l, *target);
    } else if (view.moved == i.id) {
        view.moved.clear();
        if (target) put(c, i, *target);
    }
}

void draw_floating(PanelContext& c, const Instrument& i, const Layout& l) {
    DockView& view = c.ui.docks;
    const float em = ImGui::GetFontSize();
    const ImVec2 screen = ImGui::GetIO().DisplaySize, mouse = ImGui::GetIO().MousePos;
    const ImVec2 size{std::min(i.width * em, screen.x * 0.8f), std::min(i.height * em, screen.y * 0.8f)};
    const bool taken_up = view.torn_off == i.id;
    if (view.to_front.erase(i.id) > 0) ImGui::SetNextWindowFocus();
    if (taken_up) {
        ImGui::SetNextWindowPos({mouse.x - em * 5, mouse.y - ImGui::GetFrameHeight() / 2});
        view.torn_off.clear();
    } else {
        ImGui::SetNextWindowPos({l.room.x + em * 2, l.room.y + em * 2}, ImGuiCond_FirstUseEver);
    }
    ImGui::SetNextWindowSize(size, ImGuiCond_FirstUseEver);
    bool open = true;
    const bool drawn = ImGui::Begin(i.title, &open, ImGuiWindowFlags_NoCollapse);
    if (taken_up && ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
        ImGui::StartMouseMovingWindow(ImGui::GetCurrentWindow());
        GImGui->ActiveIdClickOffset = {em * 5, ImGui::GetFrameHeight() / 2}; // not where the tab was clicked
    }
    const ImVec2 at = ImGui::GetWindowPos();
    c.ui.probe.record(std::string("Window/") + i.title, {at.x, at.y, ImGui::GetWindowWidth(), ImGui::GetFrameHeight()});
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) put(c, i, place_of(c, i).side);
    tip_for_last_item(c.ui, "Double-click to dock, or drop it on a dock or at an edge of the image.");
    draw_menu(c, i);
    guide_mark_in_title_bar(c.ui, std::string("Window guide/") + i.title, i.guide);
    follow_mouse(c, i, l);
    view.in_sight.insert(i.id);
    if (drawn) i.draw(c);
    ImGui::End();
    if (!open) i.set_open(c, false);
}

} // namespace

ViewportInsets dock_insets(PanelContext& c, std::span<const Instrument> instruments, const Region& room) {
    DockView& view = c.ui.docks;
    const Dock& dock = c.ui.settings.dock;
    const Ids open = open_instruments(instruments, c);
    for (const std::string& id : open) {
        place_of(c, *find_instrument(instruments, id));
        if (std::ranges::count(view.open, id) == 0) view.to_front.insert(id);
    }
    view.open = open;
    view.in_sight.clear();
    std::erase_if(view.to_front, [&](const std::string& id) { return std::ranges::count(open, id) == 0; });
    const bool right_dock = has_right_dock(room, ImGui::GetFontSize());
    const bool right = !docked(c, DockSide::right, right_dock).empty(), bottom = !docked(c, DockSide::bottom, right_dock).empty();
    return {.right = right, .bottom = bottom, .docks = dock.sizes};
}

void draw_docks(PanelContext& c, std::span<const Instrument> instruments, const Layout& layout) {
    const bool right_dock = has_right_dock(layout.room, ImGui::GetFontSize());
    const Ids right = docked(c, DockSide::right, right_dock), bottom = docked(c, DockSide::bottom, right_dock);
    const Ids torn_off = floating(c.ui.settings.dock, c.ui.docks.open); // panels torn off below become floating in the next frame
    draw_dock(c, instruments, DockSide::right, layout.right_dock, right);
    draw_dock(c, instruments, DockSide::bottom, layout.bottom_dock, bottom);
    for (const std::string& id : torn_off) draw_floating(c, *find_instrument(instruments, id), layout);
}

void dock_all(Dock& dock) {
    for (DockTab& tab : dock.tabs) tab.floats = false;
}

} // namespace blush
