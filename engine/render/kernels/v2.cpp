// Kernels for x86-64-v2, compiled with -march=x86-64-v2 in a namespace of their own.
#include "render/kernels/instantiate.h"

namespace blush {

std::span<const Kernel> kernels_v2() {
    static constexpr auto kernels = make_kernels<Wide, fallback_feature_sets>("v2");
    return kernels;
}

} // namespace blush
