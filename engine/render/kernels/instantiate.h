// Instantiates the kernels for the lane type and instruction set of the including file.
#pragma once

#include "render/integrator/delta_chains.h"
#include "render/integrator/light_path_sampling.h"
#include "render/integrator/light_paths.h"
#include "render/integrator/wavefront.h"
#include "render/kernels/feature_sets.h"

namespace blush::inline BLUSH_ISA {

// Delta chains share two functions: they take a small part of the time, and compile slowly.
template <const auto& sets> constexpr Features chain_features(Features needed) {
    for (const FeatureSet& set : sets)
        if (set.features.bits == untextured_features.bits && set.features.contains(needed)) return set.features;
    return all_features;
}
template <Features S, class F, const auto& sets> constexpr Kernel make_kernel(std::string_view isa, std::string_view name) {
    constexpr Features of_chains = chain_features<sets>(S.without(Feature::light_paths));
    Kernel kernel{isa, name, S, &render_tile<S, F>, &trace_delta_chains<of_chains, F>};
    if constexpr (S.has(Feature::light_paths)) {
        kernel.trace_light_paths = &trace_light_paths<S, F>;
        kernel.emit_light_paths = &emit_light_paths<F>;
    }
    return kernel;
}
template <class F, const auto& sets, size_t... I>
constexpr std::array<Kernel, sizeof...(I)> make_kernels(std::string_view isa, std::index_sequence<I...>) {
    return {make_kernel<sets[I].features, F, sets>(isa, sets[I].name)...};
}
template <class F, const auto& sets> constexpr auto make_kernels(std::string_view isa) {
    return make_kernels<F, sets>(isa, std::make_index_sequence<sets.size()>());
}

} // namespace blush::inline BLUSH_ISA
