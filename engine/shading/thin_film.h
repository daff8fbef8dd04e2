// KHR_materials_iridescence: reflectance of a surface under a thin film, after Belcour and Barla 2017, "A Practical Extension to
// Microfacet Theory for the Modeling of Varying Iridescence", as simplified by the specification: Schlick's approximation at both
// interfaces, no polarisation, real indices, two orders of interference integrated over the spectrum as a sum of Gaussians.
//
// The film is in contact with air even below a clear coat, as in the Khronos sample viewer. Not modelled: absorption in the film.
#pragma once

#include "shading/fresnel.h"

namespace blush::inline BLUSH_ISA {

// CIE XYZ, relative to white, of a spectrum modulated with this optical path difference in nanometres: the Fourier transforms of
// colour matching functions approximated by Gaussians.
template <class F> Vec<F> interference_xyz(const F& path_nm) {
    const F per_metre = path_nm * 1e-9f; // in turns per wave number
    const auto wave = [&](float height, float center, float variance) {
        const F turns = per_metre * center, phase = per_metre * (2.f * pi);
        const F fade = blush::exp(F(-variance * phase * phase));
        return height * sincos_turns(F(turns - floor(turns))).cos * fade;
    };
    // height = val sqrt(2 pi var) / 1.0685e-7, with the specification's values.
    const F x = wave(0.846578f, 1.6810e6f, 4.3278e9f) + wave(0.153866f, 2.2399e6f, 4.5282e9f);
    return {x, wave(1.000218f, 1.7953e6f, 9.3046e9f), wave(1.001124f, 2.2084e6f, 6.6121e9f)};
}

template <class F> Vec<F> linear_from_xyz(const Vec<F>& c) {
    return {3.2404542f * c.x - 1.5371385f * c.y - 0.4985314f * c.z, -0.9692660f * c.x + 1.8760108f * c.y + 0.0415560f * c.z,
            0.0556434f * c.x - 0.2040259f * c.y + 1.0572252f * c.z};
}

// A film at one cosine: the part that does not depend on the base.
template <class F> struct ThinFilm {
    F ior, reflectance; // of its outer interface
    F cos;              // within the film
    Vec<F> once, twice; // linear Rec.709 of light with a path difference of one and of two passes
};

// c: cosine in air.
template <class F> ThinFilm<F> make_thin_film(const F& ior, const F& thickness_nm, const F& c) {
    ThinFilm<F> film;
    film.ior = select(thickness_nm > F(0.f), ior, F(1.f)); // no film, no interface
    const F r0 = normal_reflectance(film.ior);
    film.reflectance = r0 + (1.f - r0) * schlick(c);
    film.cos = sqrt(max(F(0.f), F(1.f - (1.f - c * c) / (film.ior * film.ior))));
    const F path = 2.f * film.ior * thickness_nm * film.cos;
    film.once = linear_from_xyz(interference_xyz(path));
    film.twice = linear_from_xyz(interference_xyz(F(2.f * path)));
    return film;
}

// Reflectance over a base that reflects f0 at normal incidence in air,
// clamped to [0, 1]: the sum of Gaussians leaves the gamut in places.
template <class F> Vec<F> thin_film_reflectance(const ThinFilm<F>& film, const Vec<F>& f0) {
    const F outer = film.reflectance, passed = 1.f - outer, rise = schlick(film.cos);
    const auto channel = [&](const F& base, const F& once, const F& twice) {
        const F root = sqrt(min(max(base, F(0.f)), F(0.9999f)));
        const F base_ior = (1.f + root) / (1.f - root);
        const F r0 = normal_reflectance(F(base_ior / film.ior));
        const F inner = r0 + (1.f - r0) * rise;
        const F both = min(F(outer * inner), F(0.9999f));
        const F steady = passed * passed * inner / (1.f - both);
        // Reflection at a denser medium shifts the phase by half a wavelength: at both interfaces, or only at the outer one.
        const F turn = select(base_ior < film.ior, F(1.f), F(-1.f));
        return clamp01(F(outer + steady + 2.f * (steady - passed) * (turn * sqrt(both) * once + both * twice)));
    };
    return {channel(f0.x, film.once.x, film.twice.x), channel(f0.y, film.once.y, film.twice.y), channel(f0.z, film.once.z, film.twice.z)};
}

} // namespace blush::inline BLUSH_ISA
