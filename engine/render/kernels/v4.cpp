// Kernels for x86-64-v4, compiled with -march=x86-64-v4 in a namespace of their own.
#include "render/kernels/instantiate.h"

namespace blush {

std::span<const Kernel> kernels_v4() {
    static constexpr auto kernels = make_kernels<Wide, feature_sets>("v4");
    return kernels;
}

} // namespace blush
