// From spectra to colours: the CIE 1931 observer, and XYZ to the working space.
#pragma once

#include "core/vec.h"

#include <algorithm>
#include <cmath>

namespace blush {

// CIE 1931 colour matching as sums of lopsided Gaussians: Wyman, Sloan and Shirley, "Simple Analytic Approximations to the CIE XYZ Color
// Matching Functions", JCGT 2(2), 2013, multi-lobe fit. Wavelength in nm.
inline Vec3d color_matching(double nm) {
    const auto lobe = [nm](double mean, double width_below, double width_above) {
        const double t = (nm - mean) / (nm < mean ? width_below : width_above);
        return std::exp(-0.5 * t * t);
    };
    return {1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2),
            0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
            1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)};
}

// Linear Rec.709 (IEC 61966-2-1); negative components (colours out of gamut) are clamped to 0.
inline Vec3d rec709_from_xyz(const Vec3d& c) {
    return {std::max(0.0, 3.2404542 * c.x - 1.5371385 * c.y - 0.4985314 * c.z),
            std::max(0.0, -0.9692660 * c.x + 1.8760108 * c.y + 0.0415560 * c.z),
            std::max(0.0, 0.0556434 * c.x - 0.2040259 * c.y + 1.0572252 * c.z)};
}

} // namespace blush
