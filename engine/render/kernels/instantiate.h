// Instantiates the kernels for the lane type and instruction set of the including file.
#pragma once

#include "render/integrator/wavefront.h"
#include "render/kernels/feature_sets.h"

namespace blush::inline BLUSH_ISA {

template <class F, size_t... I> constexpr std::array<Kernel, sizeof...(I)> make_kernels(std::string_view isa, std::index_sequence<I...>) {
    return {Kernel{isa, feature_sets[I].name, feature_sets[I].features, &render_tile<feature_sets[I].features, F>}...};
}
template <class F> constexpr auto make_kernels(std::string_view isa) {
    return make_kernels<F>(isa, std::make_index_sequence<feature_sets.size()>());
}

} // namespace blush::inline BLUSH_ISA
