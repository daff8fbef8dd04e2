// KHR_materials_dispersion. From the first dispersive surface on, a path carries light of a single wavelength: it uses that
// wavelength's index of refraction, and its throughput is multiplied once by the wavelength's colour. The mean stays white.
#pragma once

#include "core/sampler.h"

namespace blush {

// The visible spectrum in steps of equal probability.
struct Spectrum {
    static constexpr int steps = 256;
    float nanometres[steps];
    float rgb[3 * steps]; // linear Rec.709 over the step's probability; averages exactly to white; out-of-gamut values are cut
};

// Computed on first use; deterministic. Thread-safe.
const Spectrum& visible_spectrum();

} // namespace blush

namespace blush::inline BLUSH_ISA {

// Sampler dimension outside of those used for scattering: a path has one wavelength, independent of what it hits first.
constexpr uint32_t wavelength_dimension = ~0u;

template <class F> struct Wavelength {
    F nanometres;
    Vec<F> rgb;
};
// Step of the visible spectrum.
template <class F> Int<F> wavelength_step(const Sampler<F>& sampler) {
    return min(to_int(F(sampler.pair(wavelength_dimension).x() * float(Spectrum::steps))), Int<F>(Spectrum::steps - 1));
}
template <class F> Wavelength<F> wavelength_at(const Int<F>& step) {
    const Spectrum& spectrum = visible_spectrum();
    return {gather(spectrum.nanometres, step), gather3<F>(spectrum.rgb, step)};
}
template <class F> Wavelength<F> wavelength_of(const Sampler<F>& sampler) { return wavelength_at<F>(wavelength_step<F>(sampler)); }

// Cauchy's equation from the index `ior` at 587.6 nm, as in the specification; `dispersion` is 20 / Abbe number. At least 1.
template <class F> F dispersed_ior(const F& ior, const F& dispersion, const F& nanometres) {
    return max(F(ior + (ior - 1.f) * (dispersion * 0.05f) * (523655.f / (nanometres * nanometres) - 1.5168f)), F(1.f));
}

} // namespace blush::inline BLUSH_ISA
