// The inspector: tabs, each with the sections that belong together.
#include "ui/panels/panels.h"
#include "ui/widgets/guide_mark.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <algorithm>

namespace blush {
namespace {

constexpr const char* tab_names[] = {"Selection", "Camera", "World", "Render", "Display"};

// A row of tabs and a "?". Each is as wide as its name plus an equal share of the remaining width.
void draw_tabs(PanelContext& c) {
    float rest = ImGui::GetContentRegionAvail().x - guide_mark_width();
    for (const char* name : tab_names) rest -= ImGui::CalcTextSize(name).x;
    const float gap = rest / float(std::size(tab_names)), height = ImGui::GetFrameHeight() * 1.15f;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    for (int i = 0; i < int(std::size(tab_names)); ++i) {
        if (i) ImGui::SameLine(0, 0);
        const ImVec2 low = ImGui::GetCursorScreenPos(), size = ImGui::CalcTextSize(tab_names[i]);
        const float width = std::max(size.x + gap, 1.f);
        const ImVec2 high{low.x + width, low.y + height};
        const bool current = int(c.ui.tab) == i;
        if (ImGui::InvisibleButton(tab_names[i], {width, height})) c.ui.tab = InspectorTab(i);
        c.ui.probe.record_last_item(std::string("Tab/") + tab_names[i]);
        const ImU32 color = current || ImGui::IsItemHovered() ? tone::text : tone::dim_text;
        draw.AddText({low.x + (width - size.x) / 2, low.y + (height - size.y) / 2}, color, tab_names[i]);
        const float line = std::max(1.f, ImGui::GetFontSize() / 8);
        if (current)
            draw.AddRectFilled({low.x, high.y - line}, high, tone::text);
        else
            draw.AddRectFilled({low.x, high.y - 1}, high, tone::field);
    }
    ImGui::SameLine(0, 0);
    guide_mark(c.ui, "Guide/Inspector", inspector_guide_page(c), height);
}

void draw_selection(PanelContext& c) {
    const Node* node = c.scene().nodes.find(c.ui.selected);
    if (!node) {
        draw_material_panel(c, {});
        if (!c.ui.selected_material) quiet_text("Nothing is selected. Click an object in the image or in the outliner.");
        return;
    }
    const Id<Node> id = c.ui.selected;
    draw_object_panel(c, id);
    draw_light_panel(c, id);
    draw_light_links_panel(c, id);
    draw_camera_node_panel(c, id);
    draw_transform_panel(c, id);
    draw_morph_weights_panel(c, id);
    draw_material_panel(c, id);
}

} // namespace

const char* inspector_guide_page(const PanelContext& c) {
    switch (c.ui.tab) {
    case InspectorTab::selection: {
        const Node* node = c.scene().nodes.find(c.ui.selected);
        return node && node->light ? guide_page::light_units : guide_page::materials;
    }
    case InspectorTab::camera: return guide_page::camera;
    case InspectorTab::environment: return guide_page::light_kinds;
    case InspectorTab::render: return guide_page::convergence;
    case InspectorTab::display: return guide_page::display;
    }
    return "README.html";
}

void draw_inspector(PanelContext& c) {
    draw_tabs(c);
    ImGui::BeginChild("sections", {0, 0}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    switch (c.ui.tab) {
    case InspectorTab::selection: draw_selection(c); break;
    case InspectorTab::camera: draw_camera_panel(c); break;
    case InspectorTab::environment: draw_environment_panel(c); break;
    case InspectorTab::render: draw_render_panel(c); break;
    case InspectorTab::display: draw_display_panel(c); break;
    }
    ImGui::EndChild();
}

} // namespace blush
