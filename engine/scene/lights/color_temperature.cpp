#include "scene/lights/color_temperature.h"

#include "core/math.h"
#include "core/rec709.h"
#include "scene/affine.h"
#include "scene/lights/cie_observer.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

// Planck's law without its constant factor; only the chromaticity is used.
double planck(double nm, double kelvin) {
    constexpr double second_radiation_constant = 1.438776877e7; // h c / k in nm K
    return std::pow(nm * 1e-3, -5) / std::expm1(second_radiation_constant / (nm * kelvin));
}

Vec3d black_body_xyz(double kelvin) {
    Vec3d sum{0, 0, 0};
    for (double nm = 360; nm <= 830; nm += 5) sum = sum + color_matching(nm) * planck(nm, kelvin);
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
// XYZ with luminance Y.
Vec3d to_xyz(const Chromaticity& c, double luminance) {
    const double d = 6 * luminance / c.v, x = c.u * d / 4;
    return {x, luminance, (d - x - 15 * luminance) / 3};
}

// Moved by `distance` perpendicular to the locus, towards greater v.
Vec3d off_locus(const Vec3d& xyz, double kelvin, double distance) {
    const Chromaticity here = chromaticity_of(xyz), hotter = chromaticity_of(black_body_xyz(kelvin * 1.001));
    const double du = hotter.u - here.u, dv = hotter.v - here.v, step = distance / std::hypot(du, dv);
    return to_xyz({here.u + dv * step, here.v - du * step}, xyz.y);
}

double distance_to_locus(const Chromaticity& c, double kelvin) {
    const Chromaticity locus = chromaticity_of(black_body_xyz(kelvin));
    return std::hypot(c.u - locus.u, c.v - locus.v);
}

} // namespace

ColorTemperature temperature_of(const Vec3& rgb) {
    const Vec3d xyz = transform_vector(xyz_from_rec709, to_double(rgb));
    if (!(xyz.y > 0) || !std::isfinite(xyz.x + xyz.y + xyz.z)) return {};
    const Chromaticity c = chromaticity_of(xyz);
    // Golden section over the reciprocal temperature, on which the distance has one minimum.
    constexpr double ratio = 0.6180339887498949;
    double low = 1.0 / max_kelvin, high = 1.0 / min_kelvin;
    for (int i = 0; i < 40; ++i) {
        const double a = high - ratio * (high - low), b = low + ratio * (high - low);
        if (distance_to_locus(c, 1 / a) < distance_to_locus(c, 1 / b))
            high = b;
        else
            low = a;
    }
    const double kelvin = 2 / (low + high);
    const Chromaticity here = chromaticity_of(black_body_xyz(kelvin)), hotter = chromaticity_of(black_body_xyz(kelvin * 1.001));
    const double across = (hotter.v - here.v) * (c.u - here.u) - (hotter.u - here.u) * (c.v - here.v);
    return {float(kelvin), float(std::copysign(distance_to_locus(c, kelvin), across))};
}

Vec3 black_body_color(float kelvin, float green_tint) {
    const double temperature = std::clamp(kelvin, min_kelvin, max_kelvin);
    Vec3d c = black_body_xyz(temperature);
    if (green_tint != 0) c = off_locus(c, temperature, double(green_tint));
    const Vec3d rgb = rec709_from_xyz(c);
    const double luminance = transform_vector(xyz_from_rec709, rgb).y;
    return {float(rgb.x / luminance), float(rgb.y / luminance), float(rgb.z / luminance)};
}

} // namespace blush
