// Kernels for x86-64-v3, compiled with -march=x86-64-v3 in a namespace of their own.
#include "render/kernels/instantiate.h"

namespace blush {

std::span<const Kernel> kernels_v3() {
    static constexpr auto kernels = make_kernels<Wide, feature_sets>("v3");
    return kernels;
}

} // namespace blush
