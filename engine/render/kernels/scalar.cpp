// One path at a time: the reference for tests of the wide kernels.
#include "render/kernels/instantiate.h"

namespace blush {

std::span<const Kernel> kernels_scalar() {
    static constexpr auto kernels = make_kernels<float, fallback_feature_sets>("scalar");
    return kernels;
}

} // namespace blush
