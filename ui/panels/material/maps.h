// The texture slots of a material, one row each.
#pragma once

#include "ui/panel_context.h"
#include "ui/widgets/widgets.h"

namespace blush {

// Rows with thumbnail, name, size, buttons to load, replace and remove, and the UV transform. `m` is the edited copy of material
// `id`.
void draw_material_maps(Fields& f, PanelContext& c, Id<Material> id, Material& m);

} // namespace blush
