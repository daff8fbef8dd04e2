// Lights dragged from row to row, in outliner and light table: into the group of whatever they are dropped on.
#pragma once

#include "ui/panels/context.h"

#include <optional>
#include <string>

namespace blush {

// The row drawn last can be dragged: its light, and all that is selected with it. No node stands for the environment.
void drag_light(Id<Node> node, const std::string& name);
// What was let go over the row drawn last; nothing in most frames.
std::optional<Id<Node>> light_dropped_here();
void put_dropped_into_group(PanelContext& c, Id<Node> dropped, const std::string& group);

} // namespace blush
