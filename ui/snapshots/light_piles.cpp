#include "ui/snapshots/light_piles.h"

#include "core/math.h"

namespace blush {

TwoPiles piles_of(const Frame& frame, size_t pixel) {
    TwoPiles piles;
    for (size_t k = 0; k < frame.bounces.size(); ++k) {
        Vec3& pile = k < 2 ? piles.direct : piles.indirect;
        pile = pile + frame.bounces[k][pixel];
    }
    return piles;
}

} // namespace blush
