// White balance by chromatic adaptation.
#pragma once

#include "core/vec.h"

namespace blush {

// The linear map of scene-linear Rec.709 values that turns `neutral` into the grey of its luminance, as seen by adapted eyes:
// Lam's Bradford cone responses with von Kries scaling (CIE 160:2004). The identity for greys and for invalid colours: components
// that are negative, not finite or all 0.
Affine white_balance(const Vec3& neutral);

} // namespace blush
