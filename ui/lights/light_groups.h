// Light groups that the user has named.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace blush {

// Names of the groups of lights on nodes and of the environment, sorted, without "".
std::vector<std::string> group_names(const Scene& scene);
// "Group 1", or the first unused number after it.
std::string unused_group_name(const Scene& scene);

} // namespace blush
