// The images on a material, a row each.
#pragma once

#include "ui/panels/context.h"
#include "ui/widgets.h"

namespace blush {

// Thumbnail, name and size, with what loads, replaces and removes it, and how it lies. `id` is the material that `m` is being edited of.
void draw_material_maps(Fields& f, PanelContext& c, Id<Material> id, Material& m);

} // namespace blush
