// Outliner: the scene's nodes as a tree, with icons for content and visibility.
#include "scene/node_name.h"
#include "ui/gl/icons.h"
#include "ui/lights/light_tools.h"
#include "ui/panels/light/drag.h"
#include "ui/panels/panels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/guide_mark.h"
#include "ui/widgets/row_clicks.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include "scene/animation/pose.h"
#include "scene/lights/light_visibility.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui_stdlib.h>
#include <map>

namespace blush {
namespace {

using Children = std::map<Id<Node>, std::vector<Id<Node>>>;

// State that the rows of one frame share.
struct Rows {
    Children children;
    bool some_solo = false;
    RowClicks clicks;
};

Children children_of(const Scene& scene) {
    Children children;
    for (const auto& [id, node] : scene.nodes)
        if (!is_root_of_other_scene(scene, node)) children[node.parent].push_back(id);
    return children;
}

Icon icon_of(const Scene& scene, const Node& node) {
    if (const Light* light = scene.lights.find(node.light)) return icon_of(light->kind);
    return node.mesh ? Icon::mesh : node.camera ? Icon::camera : Icon::group;
}

void draw_rename(PanelContext& c, Id<Node> id, const Node& node) {
    ImGui::SetNextItemWidth(-ImGui::GetFrameHeight());
    ImGui::SetKeyboardFocusHere();
    const bool entered =
        ImGui::InputText("##rename", &c.ui.rename_text, ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
    const bool left = ImGui::IsItemDeactivated();
    if (!entered && !left) return;
    c.ui.renaming = {};
    if (!ImGui::IsItemDeactivatedAfterEdit() && !entered) return;
    Node renamed = node;
    renamed.name = c.ui.rename_text;
    c.apply(SetNode{id, renamed});
}

void draw_eye(PanelContext& c, Id<Node> id, const Node& node) {
    const float size = ImGui::GetFrameHeight();
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - size);
    if (icon_button("eye", node.visible ? Icon::eye : Icon::eye_closed, node.visible ? tone::dim_text : IM_COL32(95, 95, 95, 255))) {
        Node changed = node;
        changed.visible = !node.visible;
        c.apply(SetNode{id, changed});
    }
    tip_for_last_item(c.ui, node.visible ? "Hide" : "Show");
}

void draw_node(PanelContext& c, Rows& rows, Id<Node> id, int depth) {
    const Node* found = c.scene().nodes.find(id);
    if (!found || depth > 200) return;
    const Node node = *found;
    const auto below = rows.children.find(id);
    const bool leaf = below == rows.children.end();
    ImGui::PushID(int(id.value));
    ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_SpanFullWidth | ImGuiTreeNodeFlags_FramePadding |
                               ImGuiTreeNodeFlags_AllowItemOverlap;
    if (leaf) flags |= ImGuiTreeNodeFlags_Leaf;
    if (c.ui.is_selected(id)) flags |= ImGuiTreeNodeFlags_Selected;
    const bool open_at_first = depth < 2;
    ImGui::SetNextItemOpen(open_at_first != c.ui.turned.contains(id));
    const bool open = ImGui::TreeNodeEx("##node", flags);
    if (ImGui::IsItemToggledOpen() && !c.ui.turned.erase(id)) c.ui.turned.insert(id);
    const std::string name = node_name(c.scene(), id, node);
    c.ui.probe.record_last_item("Outliner/" + name);
    if (c.scene().lights.contains(node.light)) {
        drag_light(id, name);
        const std::string& group = c.scene().lights.find(node.light)->group;
        if (const auto dropped = dropped_light()) put_dropped_into_group(c, *dropped, group);
    }
    const Mesh* mesh = c.scene().meshes.find(node.mesh);
    rows.clicks.row(id, ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen(),
                    mesh && !mesh->parts.empty() ? mesh->parts[0].material : Id<Material>{});
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) c.ui.commands.push_back(Command::frame_selection);
    if (c.ui.selected == id && c.ui.scroll_to_selected) {
        if (!ImGui::IsItemVisible()) ImGui::SetScrollHereY();
        c.ui.scroll_to_selected = false;
    }
    ImGui::SameLine(0, 0);
    const Light* light = c.scene().lights.find(node.light);
    const bool quiet = !node.visible || (light && !emits_light(*light, rows.some_solo));
    icon_item(icon_of(c.scene(), node), quiet ? IM_COL32(95, 95, 95, 255) : light ? tone::light : tone::dim_text, ImGui::GetFrameHeight());
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    if (c.ui.renaming == id)
        draw_rename(c, id, node);
    else {
        const float before_eye = ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() - ImGui::GetStyle().ItemSpacing.x;
        elided_text(c.ui, name, quiet ? tone::dim_text : tone::text, before_eye);
    }
    draw_eye(c, id, node);
    if (open) {
        if (!leaf) {
            for (const Id<Node> child : below->second) draw_node(c, rows, child, depth + 1);
        }
        ImGui::TreePop();
    }
    ImGui::PopID();
}

// Scene and material variant, if the file has several.
void draw_choices(PanelContext& c) {
    const Scene& scene = c.scene();
    SceneSelection scene_selection = scene.scene_selection;
    const auto choose = [&](const char* label, int32_t& index, std::vector<std::string> names, int32_t first, const char* tip) {
        for (size_t i = 0; i < names.size(); ++i) names[i] += fmt::format("##{}", i); // names may be equal
        Fields f(c.ui, "Outliner");
        std::string name = names.at(size_t(index - first));
        if (f.choice(label, name, names, tip)) index = int32_t(std::ranges::find(names, name) - names.begin()) + first;
    };
    if (!scene.scene_names.empty()) choose("Scene", scene_selection.scene, scene.scene_names, 0, "Scene of the file to show.");
    if (!scene.variants.empty()) {
        std::vector<std::string> names{"Default"};
        names.insert(names.end(), scene.variants.begin(), scene.variants.end());
        choose("Materials", scene_selection.variant, std::move(names), -1, "Material variant of the file (KHR_materials_variants).");
    }
    if (scene_selection != scene.scene_selection) c.apply(SetSceneSelection{scene_selection});
}

void draw_add_light(PanelContext& c) {
    const float padding = ImGui::GetStyle().WindowPadding.x; // the mark is at the outliner's edge, as in the inspector
    if (ImGui::Button("Add light", {ImGui::GetContentRegionAvail().x + padding - guide_mark_width(), 0})) ImGui::OpenPopup("add light");
    c.ui.probe.record_last_item("Outliner/Add light");
    ImGui::SameLine(0, 0);
    guide_mark(c.ui, "Guide/Outliner", guide_page::outliner, ImGui::GetFrameHeight());
    if (!ImGui::BeginPopup("add light")) return;
    for (const Command command :
         {Command::add_point, Command::add_spot, Command::add_sun, Command::add_rectangle, Command::add_disk, Command::add_sphere}) {
        if (ImGui::MenuItem(shortcut(command).name, to_string(shortcut(command).press).c_str())) c.ui.commands.push_back(command);
        c.ui.probe.record_last_item(std::string("Outliner/Add light/") + shortcut(command).name);
    }
    ImGui::EndPopup();
}

} // namespace

void draw_outliner(PanelContext& c) {
    draw_add_light(c);
    draw_choices(c);
    ImGui::Spacing();
    ImGui::BeginChild("nodes");
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x * 0.5f, ImGui::GetStyle().FramePadding.y});
    Rows rows{children_of(c.scene()), any_solo(c.scene()), {}};
    if (const auto roots = rows.children.find({}); roots != rows.children.end()) {
        for (const Id<Node> id : roots->second) draw_node(c, rows, id, 0);
    }
    rows.clicks.finish(c.ui);
    ImGui::PopStyleVar(2);
    if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsAnyItemHovered()) c.ui.select({});
    ImGui::EndChild();
}

} // namespace blush
