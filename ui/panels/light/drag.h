// Drag and drop of light rows in outliner and light table: the drop target's group receives the lights.
#pragma once

#include "ui/panel_context.h"

#include <optional>
#include <string>

namespace blush {

// Makes the row drawn last a drag source: its light and all selected lights. The environment has no node.
void drag_light(Id<Node> node, const std::string& name);
// The payload dropped on the row drawn last, if any.
std::optional<Id<Node>> dropped_light();
void put_dropped_into_group(PanelContext& c, Id<Node> dropped, const std::string& group);

} // namespace blush
