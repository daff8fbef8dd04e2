// MIS weights of next event estimation and BSDF sampling (Veach 1997, section 9.2). For a direction that both can sample the two weights
// sum to 1, by any heuristic.
#pragma once

#include "core/sampling.h"
#include "render/integrator/estimator_settings.h"

namespace blush::inline BLUSH_ISA {

// Heuristics other than the default, for comparison; kept out of line, so that the default costs no more. `ties`: of the maximum
// heuristic, true for one of the two strategies.
template <class F> [[gnu::noinline]] F other_mis_weight(const MisHeuristic& heuristic, const F& pdf, const F& other, bool ties) {
    const F balance = 1.f / (1.f + other / pdf);
    switch (heuristic.rule) {
    case MisHeuristic::Rule::power: {
        F ratio = other / pdf, power = ratio;
        for (int i = 1; i < heuristic.exponent; ++i) power = power * ratio;
        return 1.f / (1.f + power);
    }
    case MisHeuristic::Rule::cutoff: {
        const F least = max(pdf, other) * heuristic.threshold;
        return select(pdf < least, F(0.f), select(other < least, F(1.f), balance));
    }
    case MisHeuristic::Rule::maximum: return select(ties ? pdf >= other : pdf > other, F(1.f), F(0.f));
    }
    return balance;
}
template <class F> F mis_weight(const MisSettings& mis, const F& pdf, const F& other, bool ties) {
    return mis.default_heuristic ? power_heuristic(pdf, other) : other_mis_weight<F>(mis.heuristic, pdf, other, ties);
}

// Of NEE; delta lights cannot be hit, so their weight is always 1.
template <class F> F nee_mis_weight(const MisSettings& mis, const F& light_pdf, const F& bsdf_pdf, const Mask<F>& delta) {
    if (mis.strategy == Strategy::bsdf) return select(delta, F(1.f), F(0.f));
    if (mis.strategy == Strategy::light) return F(1.f);
    return select(delta, F(1.f), mis_weight<F>(mis, light_pdf, bsdf_pdf, true));
}

// Of emission hit by a BSDF-sampled ray; light_pdf is the pdf of NEE for the same direction.
template <class F> F emission_mis_weight(const MisSettings& mis, const F& bsdf_pdf, const F& light_pdf) {
    const Mask<F> only_found = bsdf_pdf == F(infinity) || light_pdf == F(0.f);
    if (mis.strategy == Strategy::bsdf) return F(1.f);
    if (mis.strategy == Strategy::light) return select(only_found, F(1.f), F(0.f));
    return select(only_found, F(1.f), mis_weight<F>(mis, bsdf_pdf, light_pdf, false));
}

} // namespace blush::inline BLUSH_ISA
