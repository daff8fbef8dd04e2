// Scenes whose pictures are known, those of the stability battery, and those that are shipped.
#pragma once

#include "measure/stability/scenes.h"

#include <string>
#include <vector>

namespace blush::test {

using namespace stability;

// One of assets/scenes by name; ends the test if it cannot be read.
Scene shipped_scene(const std::string& name);
const std::vector<std::string>& shipped_scene_names();

// A bulb so strong and so near to the floor below it that its irradiance overflows in the middle of the picture.
Scene floor_under_an_overflowing_bulb();

} // namespace blush::test
