#include "scene/lights/light_units.h"

#include "core/math.h"
#include "scene/lights/color_temperature.h"
#include "scene/lights/ies_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

using std::numbers::pi;

// Projected area along the light's axis, m^2.
double face_area(const Light& light, double area_scale) {
    const double r = double(light.radius);
    return (light.kind == Light::Kind::rectangle ? double(light.width) * double(light.height) : pi * r * r) * area_scale;
}

bool has_spread(const Light& light) {
    return (light.kind == Light::Kind::rectangle || light.kind == Light::Kind::disk) && light.spread_radians < float(pi);
}

// Ratio of the on-axis radiance to Light::intensity: above 1 if the spread narrows the emission.
double spread_gain(const Light& light) {
    const double half = 0.5 * double(light.spread_radians);
    return has_spread(light) ? std::tan(half) / (std::tan(half) - half) : 1;
}

// KHR_lights_punctual's falloff.
double cone_factor(const Light& light, double cosine) {
    const double inner = std::cos(double(light.inner_cone_radians)), outer = std::cos(double(light.outer_cone_radians));
    const double f = std::clamp((cosine - outer) / std::max(0.001, inner - outer), 0.0, 1.0);
    return f * f;
}

// Integral over the sphere of the factor (cone or IES profile) on the candela of a point or spot light.
double directional_share(const Light& light) {
    const bool is_spot = light.kind == Light::Kind::spot;
    if (!is_spot) return light.ies ? luminous_flux(*light.ies) / double(light.ies->peak) : 4 * pi;
    if (!light.ies) {
        const double inner = std::cos(double(light.inner_cone_radians)), outer = std::cos(double(light.outer_cone_radians));
        const double ramp = std::max(0.001, inner - outer), full = std::min(outer + ramp, 1.0);
        // (full - outer)^3 / (3 ramp^2) on the ramp, 1 within it.
        return 2 * pi * (1 - full + std::pow(full - outer, 3) / (3 * ramp * ramp));
    }
    constexpr int rings = 256, sectors = 128;
    const double height = 1 - std::cos(double(light.outer_cone_radians));
    double sum = 0;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            const double cosine = 1 - height * (i + 0.5) / rings, sine = std::sqrt(1 - cosine * cosine),
                         turn = 2 * pi * (j + 0.5) / sectors;
            sum += cone_factor(light, cosine) * candela_towards(*light.ies, {sine * std::cos(turn), sine * std::sin(turn), -cosine});
        }
    return sum * 2 * pi * height / (rings * sectors) / double(light.ies->peak);
}

// Lumens of a light of intensity 1.
double flux_of_one(const Light& light, double area_scale) {
    switch (light.kind) {
    case Light::Kind::point:
    case Light::Kind::spot: return directional_share(light);
    case Light::Kind::rectangle:
    case Light::Kind::disk: return pi * face_area(light, area_scale) * (light.two_sided ? 2 : 1);
    case Light::Kind::sphere: return 4 * pi * face_area(light, area_scale);
    case Light::Kind::sun: break;
    }
    return 0;
}

// On-axis candela of a light of intensity 1; for a sun (infinitely far), the candela that gives its lux at unit_distance.
double candela_of_one(const Light& light, double area_scale) {
    if (light.kind == Light::Kind::sun) return unit_distance * unit_distance;
    return is_per_area(light.kind) ? face_area(light, area_scale) * spread_gain(light) : 1;
}

// Luminance of the disk of a sun of one lux, nits.
double nits_of_one(const Light& light) {
    if (light.kind != Light::Kind::sun) return 1;
    const double sine = std::sin(0.5 * double(light.angle_radians));
    return 1 / (pi * sine * sine);
}

// Strength of a light of intensity 1 in a unit; for ev, the linear value whose logarithm it is.
double of_one(const Light& light, Light::Unit unit, double area_scale) {
    switch (unit) {
    case Light::Unit::own: return 1;
    case Light::Unit::watt: return flux_of_one(light, area_scale) / lumens_per_watt;
    case Light::Unit::lumen: return flux_of_one(light, area_scale);
    case Light::Unit::candela: return candela_of_one(light, area_scale);
    case Light::Unit::lux: return candela_of_one(light, area_scale) / (unit_distance * unit_distance);
    case Light::Unit::nits: return nits_of_one(light);
    case Light::Unit::ev: return is_per_area(light.kind) ? 8 : candela_of_one(light, area_scale) / (unit_distance * unit_distance) / 2.5;
    }
    return 1;
}

} // namespace

bool is_per_area(Light::Kind kind) { return kind == Light::Kind::rectangle || kind == Light::Kind::disk || kind == Light::Kind::sphere; }

bool has_unit(const Light& light, Light::Unit unit) {
    const bool is_sun = light.kind == Light::Kind::sun;
    switch (unit) {
    case Light::Unit::watt:
    case Light::Unit::lumen:
    case Light::Unit::candela: return !is_sun;
    case Light::Unit::nits: return is_per_area(light.kind) || (is_sun && light.angle_radians > 0);
    case Light::Unit::own:
    case Light::Unit::lux:
    case Light::Unit::ev: return true;
    }
    return true;
}

Light::Unit own_unit(Light::Kind kind) {
    return kind == Light::Kind::sun ? Light::Unit::lux : is_per_area(kind) ? Light::Unit::nits : Light::Unit::candela;
}

Vec3 light_emission(const Light& light) {
    const Vec3 tint = light.use_temperature ? light.color * black_body_color(light.kelvin, light.green_tint) : light.color;
    return tint * light.intensity;
}

double in_unit(const Light& light, Light::Unit unit, double area_scale) {
    const double strength = double(light.intensity) * of_one(light, unit, area_scale);
    return unit == Light::Unit::ev ? std::log2(strength) : strength;
}

float intensity_of(const Light& light, Light::Unit unit, double value, double area_scale) {
    if (!has_unit(light, unit)) return 0;
    const double intensity = (unit == Light::Unit::ev ? std::exp2(value) : value) / of_one(light, unit, area_scale);
    return intensity >= 0 && std::isfinite(float(intensity)) ? float(intensity) : 0;
}

double luminous_flux(const Light& light, double area_scale) { return double(light.intensity) * flux_of_one(light, area_scale); }

Light with_same_power(const Light& before, Light after) {
    if (!after.keep_power || !is_per_area(after.kind) || before.kind != after.kind) return after;
    const double kept = double(after.intensity) * flux_of_one(before, 1) / flux_of_one(after, 1);
    if (std::isfinite(float(kept))) after.intensity = float(kept);
    return after;
}

} // namespace blush
