// Chromatic adaptation: which colour looks white.
#pragma once

#include "core/vec.h"

namespace blush {

// The linear map of scene-linear Rec.709 values that turns `neutral` into the grey of its luminance, as eyes that have adapted to that
// colour see it: Lam's Bradford cone responses scaled as von Kries proposed (CIE 160:2004). The identity for greys, and for what is not a
// colour: components that are negative, not finite or all 0.
Affine white_balance(const Vec3& neutral);

} // namespace blush
