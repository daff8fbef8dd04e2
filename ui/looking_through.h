// The viewport while it looks through a light: eye and light move as one.
#pragma once

#include "ui/panels/context.h"

namespace blush {

// The light that is looked through; null if none is.
const Light* looked_through_light(const PanelContext& c);
// The view goes where the light is, whatever has moved that. A light that is gone is looked through no more.
void follow_looked_through(PanelContext& c);
// And where the view has gone, the light goes.
void carry_light_along(PanelContext& c);

} // namespace blush
