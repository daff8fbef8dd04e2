#include "scene/color_temperature.h"

#include "core/math.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

// CIE 1931 colour matching as sums of lopsided Gaussians: Wyman, Sloan and Shirley, "Simple Analytic Approximations to the CIE XYZ Color
// Matching Functions", JCGT 2(2), 2013, multi-lobe fit. Wavelengths in nm.
double lobe(double nm, double mean, double width_below, double width_above) {
    const double t = (nm - mean) / (nm < mean ? width_below : width_above);
    return std::exp(-0.5 * t * t);
}
double x_bar(double nm) {
    return 1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) - 0.065 * lobe(nm, 501.1, 20.4, 26.2);
}
double y_bar(double nm) { return 0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1); }
double z_bar(double nm) { return 1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8); }

// Planck's law up to a factor: only the colour matters here.
double planck(double nm, double kelvin) {
    constexpr double second_radiation_constant = 1.438776877e7; // h c / k in nm K
    return std::pow(nm * 1e-3, -5) / std::expm1(second_radiation_constant / (nm * kelvin));
}

Vec3d black_body_xyz(double kelvin) {
    Vec3d sum{0, 0, 0};
    for (double nm = 360; nm <= 830; nm += 5) sum = sum + Vec3d{x_bar(nm), y_bar(nm), z_bar(nm)} * planck(nm, kelvin);
    return sum;
}

// CIE 1960 uniform chromaticity scale.
struct Chromaticity {
    double u, v;
};
Chromaticity chromaticity_of(const Vec3d& xyz) {
    const double d = xyz.x + 15 * xyz.y + 3 * xyz.z;
    return {4 * xyz.x / d, 6 * xyz.y / d};
}
// Of luminance Y.
Vec3d to_xyz(const Chromaticity& c, double luminance) {
    const double d = 6 * luminance / c.v, x = c.u * d / 4;
    return {x, luminance, (d - x - 15 * luminance) / 3};
}

// Moved by `distance` at right angles to the locus, towards greater v.
Vec3d off_locus(const Vec3d& xyz, double kelvin, double distance) {
    const Chromaticity here = chromaticity_of(xyz), hotter = chromaticity_of(black_body_xyz(kelvin * 1.001));
    const double du = hotter.u - here.u, dv = hotter.v - here.v, step = distance / std::hypot(du, dv);
    return to_xyz({here.u + dv * step, here.v - du * step}, xyz.y);
}

} // namespace

Vec3 black_body_color(float kelvin, float green_tint) {
    const double temperature = std::clamp(kelvin, min_kelvin, max_kelvin);
    Vec3d c = black_body_xyz(temperature);
    if (green_tint != 0) c = off_locus(c, temperature, double(green_tint));
    // XYZ to linear Rec.709 (IEC 61966-2-1).
    const double r = std::max(0.0, 3.2404542 * c.x - 1.5371385 * c.y - 0.4985314 * c.z);
    const double g = std::max(0.0, -0.9692660 * c.x + 1.8760108 * c.y + 0.0415560 * c.z);
    const double b = std::max(0.0, 0.0556434 * c.x - 0.2040259 * c.y + 1.0572252 * c.z);
    const double luminance = 0.2126729 * r + 0.7151522 * g + 0.0721750 * b;
    return {float(r / luminance), float(g / luminance), float(b / luminance)};
}

} // namespace blush
