// The units in which people state the strength of a light, and what the scene keeps: candela of points and spots, lux of suns, nits of
// those with an area (Light::intensity).
//
// All of white light: the colour, which multiplies it, is not counted. What each unit means:
//   watt     radiant watts of 683 lm each (lumens_per_watt): the luminous efficacy of monochromatic light of 555 nm, by which the SI defines
//            the candela and by which programs that keep lights in watts exchange them with glTF. It is no lamp's electrical power.
//   lumen    luminous flux in all directions
//   candela  luminous intensity straight ahead; with a cone or a measured distribution, the greatest
//   lux      illuminance of a surface that faces the light, one metre (unit_distance) from it, as if it were small; a sun's is its own
//   nits     luminance of what shines; of a sun, of its disk
//   ev       exposure value at ISO 100: by reflected light for nits, L = 2^EV / 8 (K = 12.5), else by incident light, E = 2.5 * 2^EV (C = 250),
//            ISO 2720
#pragma once

#include "scene/scene.h"

namespace blush {

constexpr double lumens_per_watt = 683;
constexpr double unit_distance = 1; // metres

// Its intensity is a luminance: of a rectangle, a disk or a sphere.
bool is_per_area(Light::Kind kind);
// A light of that kind can be stated in the unit: a sun has no lumens, a point no nits.
bool has_unit(const Light& light, Light::Unit unit);
// The unit that Light::intensity is kept in.
Light::Unit own_unit(Light::Kind kind);

// The strength of `light` in a unit that it has; Light::Unit::own is its own. `area_scale`: by how much the light's node makes areas larger.
// EV of a light without intensity is -infinity.
double in_unit(const Light& light, Light::Unit unit, double area_scale = 1);
// The intensity of a light whose strength in that unit is `value`; 0 where that is no number from 0 or the light has no such unit.
float intensity_of(const Light& light, Light::Unit unit, double value, double area_scale = 1);

// Luminous flux in lumens; 0 for a sun, which has none.
double luminous_flux(const Light& light, double area_scale = 1);

// `after`, a resized `before`: if it keeps its power, with the intensity that gives the same flux.
Light with_power_kept(const Light& before, Light after);

} // namespace blush
