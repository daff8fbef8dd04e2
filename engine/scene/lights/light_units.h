// Converts between the photometric and radiometric units of lights in the UI and the units stored in Light::intensity: candela
// for point and spot lights, lux for suns, nits for area lights.
//
// Values are for white light; the light's colour multiplies it and is not included. Meaning of each unit:
//   watt     radiant watts of 683 lm each (lumens_per_watt): the luminous efficacy of monochromatic light of 555 nm, by which the SI
//   defines
//            the candela and by which programs that keep lights in watts exchange them with glTF. It is not electrical power.
//   lumen    luminous flux in all directions
//   candela  on-axis luminous intensity; with a cone or an IES profile, the maximum
//   lux      illuminance of a surface facing the light at one metre (unit_distance), as of a point source; a sun's own, at any distance
//   nits     luminance of the emitting surface; of a sun, of its disk
//   ev       exposure value at ISO 100: by reflected light for nits, L = 2^EV / 8 (K = 12.5), else by incident light, E = 2.5 * 2^EV (C =
//   250),
//            ISO 2720
#pragma once

#include "scene/scene.h"

namespace blush {

constexpr double lumens_per_watt = 683;
constexpr double unit_distance = 1; // metres

// True if the intensity is a luminance: rectangle, disk and sphere.
bool is_per_area(Light::Kind kind);
// True if the light can be stated in the unit: a sun has no lumens, a point no nits.
bool has_unit(const Light& light, Light::Unit unit);
// The unit of Light::intensity for this kind.
Light::Unit own_unit(Light::Kind kind);

// Linear RGB times intensity: colour, temperature and intensity of a light in its own unit.
Vec3 light_emission(const Light& light);

// The strength of `light` in a unit that it has (has_unit); Light::Unit::own is that of Light::intensity. `area_scale`: factor by
// which the node's transform scales areas. The EV of intensity 0 is -infinity.
double in_unit(const Light& light, Light::Unit unit, double area_scale = 1);
// Light::intensity for a strength of `value` in that unit; 0 if `value` is negative or NaN, or if the light has no such unit.
float intensity_of(const Light& light, Light::Unit unit, double value, double area_scale = 1);

// Luminous flux in lumens; 0 for a sun.
double luminous_flux(const Light& light, double area_scale = 1);

// Returns `after`, a resized `before`. With keep_power, its intensity is changed to give the same flux.
Light with_same_power(const Light& before, Light after);

} // namespace blush
