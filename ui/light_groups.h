// The groups that lights are sorted into by hand.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace blush {

// Of the lights that nodes carry and of the environment, in alphabetical order, without "".
std::vector<std::string> group_names(const Scene& scene);
// "Group 1", or the first number after it that is free.
std::string unused_group_name(const Scene& scene);

} // namespace blush
