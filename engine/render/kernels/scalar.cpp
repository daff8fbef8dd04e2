// One path at a time: the oracle that the wide kernels are compared with.
#include "render/kernels/instantiate.h"

namespace blush {

std::span<const Kernel> kernels_scalar() {
    static constexpr auto kernels = make_kernels<float>("scalar");
    return kernels;
}

} // namespace blush
