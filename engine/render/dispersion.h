// KHR_materials_dispersion. A path that meets glass of that kind carries light of one wavelength from there on: its index of refraction
// is that wavelength's, its throughput is multiplied with the wavelength's colour once. White light comes out white in the mean.
#pragma once

#include "core/sampler.h"

namespace blush {

// The visible spectrum in steps of equal probability.
struct Spectrum {
    static constexpr int steps = 256;
    float nanometres[steps];
    float rgb[3 * steps]; // linear Rec.709 over the step's probability: the mean of all is exactly white; what that cannot show is cut
};

// Computed when first asked for; deterministic. Thread-safe.
const Spectrum& visible_spectrum();

} // namespace blush

namespace blush::inline BLUSH_ISA {

// Beyond any that scattering uses: a path has one wavelength, whatever it meets first.
constexpr uint32_t wavelength_dimension = ~0u;

template <class F> struct Wavelength {
    F nanometres;
    Vec<F> rgb;
};
template <class F> Wavelength<F> wavelength_of(const Sampler<F>& sampler) {
    const Spectrum& spectrum = visible_spectrum();
    const Int<F> step = min(to_int(F(sampler.pair(wavelength_dimension).x() * float(Spectrum::steps))), Int<F>(Spectrum::steps - 1));
    return {gather(spectrum.nanometres, step), gather3<F>(spectrum.rgb, step)};
}

// Cauchy's equation through the index `ior` at 587.6 nm, as the specification has it; `dispersion` is 20 over the Abbe number. At least 1.
template <class F> F dispersed_ior(const F& ior, const F& dispersion, const F& nanometres) {
    return max(F(ior + (ior - 1.f) * (dispersion * 0.05f) * (523655.f / (nanometres * nanometres) - 1.5168f)), F(1.f));
}

} // namespace blush::inline BLUSH_ISA
