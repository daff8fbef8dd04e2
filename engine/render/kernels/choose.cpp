#include "render/kernels/kernel.h"

#include <array>
#include <cstdlib>

namespace blush {
namespace {

const Kernel& smallest_of(std::span<const Kernel> kernels, Features needed) {
    for (const Kernel& kernel : kernels)
        if (kernel.features.contains(needed)) return kernel;
    return kernels.back();
}

} // namespace

std::span<const std::string_view> runnable_isas() {
    static const auto isas = [] {
        __builtin_cpu_init();
        std::pair<std::array<std::string_view, 4>, size_t> found{{"scalar"}, 1};
#ifndef BLUSH_SCALAR_KERNELS_ONLY
        const auto add = [&](std::string_view name) { found.first[found.second++] = name; };
        if (__builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt")) add("v2");
        if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")) add("v3");
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd"))
            add("v4");
#endif
        return found;
    }();
    return {isas.first.data(), isas.second};
}

std::span<const Kernel> kernels_of(std::string_view isa) {
    if (isa == "scalar") return kernels_scalar();
#ifndef BLUSH_SCALAR_KERNELS_ONLY
    if (isa == "v2") return kernels_v2();
    if (isa == "v3") return kernels_v3();
    if (isa == "v4") return kernels_v4();
#endif
    return {};
}

const Kernel& choose_kernel(Features needed) {
    std::string_view isa = runnable_isas().back();
    if (const char* wanted = std::getenv("BLUSH_ISA"))
        for (const std::string_view runnable : runnable_isas())
            if (runnable == wanted) isa = runnable;
    return smallest_of(kernels_of(isa), needed);
}

const Kernel& kernel_like(const Kernel& kernel, Features needed) { return smallest_of(kernels_of(kernel.isa), needed); }

} // namespace blush
