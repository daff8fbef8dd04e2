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

} // namespace blush::test
