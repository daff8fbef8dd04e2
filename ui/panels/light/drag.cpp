#include "ui/panels/light/drag.h"

#include "ui/lights/light_rows.h"
#include "ui/lights/multi_edit.h"

#include <imgui.h>

namespace blush {
namespace {

constexpr const char* payload_type = "light";

} // namespace

void drag_light(Id<Node> node, const std::string& name) {
    if (!ImGui::BeginDragDropSource()) return;
    ImGui::SetDragDropPayload(payload_type, &node, sizeof node);
    ImGui::TextUnformatted(name.c_str());
    ImGui::EndDragDropSource();
}

std::optional<Id<Node>> dropped_light() {
    std::optional<Id<Node>> node;
    if (!ImGui::BeginDragDropTarget()) return node;
    if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(payload_type)) node = *static_cast<const Id<Node>*>(payload->Data);
    ImGui::EndDragDropTarget();
    return node;
}

void put_dropped_into_group(PanelContext& c, Id<Node> dropped, const std::string& group) {
    const std::string what = group.empty() ? "Ungroup" : "Group";
    if (!dropped) {
        c.apply(put_into_group(c.scene(), {}, true, group), what + " environment");
        return;
    }
    std::vector<Id<Node>> nodes{dropped};
    if (c.ui.is_selected(dropped)) nodes = c.ui.selection(c.scene());
    const std::vector<Id<Light>> lights = lights_of(c.scene(), nodes);
    c.apply(put_into_group(c.scene(), lights, false, group), label_for(what, c.scene(), lights, nodes));
}

} // namespace blush
