#include "render/biased/indirect_light.h"

namespace blush {

TileScratch& PreparationContext::scratch_of(unsigned worker) const {
    if (!scratch[worker]) scratch[worker] = std::make_unique<TileScratch>();
    return *scratch[worker];
}

} // namespace blush
