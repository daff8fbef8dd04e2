// Test scenes with known images, those of the stability battery, and the shipped ones.
#pragma once

#include "measure/stability/scenes.h"

#include <string>
#include <vector>

namespace blush::test {

using namespace stability;

// One of assets/scenes by name; ends the test if it cannot be read.
Scene shipped_scene(const std::string& name);
// Those without caustics, which have references, and the demo scenes of caustics.
const std::vector<std::string>& shipped_scene_names();
const std::vector<std::string>& caustic_scene_names();

// Window glass as glTF writes it, a pane: transmission without volume, no roughness.
Material window_glass(const Vec3& tint = {1, 1, 1});

// A light of this radius, metres, and intensity, candela.
void place_sphere_light(Scene& scene, const Vec3& position, float radius, float intensity);

// A glass ball on a floor in the light of a wide sun.
Scene glass_ball_in_sun();
// A shipped scene with suns and lamps so large that paths without the strategies for caustics find them too: means of fewer would
// not be normal.
Scene with_wide_lights(const std::string& name);

// A light so strong and so close to the floor that its irradiance overflows in the middle of the image.
Scene floor_under_an_overflowing_bulb();

} // namespace blush::test
