// CIE XYZ of linear Rec.709 with white D65, the colours of every scene.
#pragma once

#include "core/vec.h"

namespace blush {

// Columns. IEC 61966-2-1.
constexpr Affined xyz_from_rec709{
    {0.4124564, 0.2126729, 0.0193339}, {0.3575761, 0.7151522, 0.1191920}, {0.1804375, 0.0721750, 0.9503041}, {0, 0, 0}};

} // namespace blush
