// Lights dragged from row to row, in outliner and light table: into the group of whatever they are dropped on.
#pragma once

#include "ui/panels/context.h"

#include <string>

namespace blush {

// The row drawn last can be dragged: its light, and all that is selected with it.
void drag_light(Id<Node> node, const std::string& name);
// The light that was let go over the row drawn last; none in most frames.
Id<Node> light_dropped_here();
void put_dropped_into_group(PanelContext& c, Id<Node> dropped, const std::string& group);

} // namespace blush
