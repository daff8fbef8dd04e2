// What files can hold of a project that random edits have made.
#pragma once

#include "scene/edit.h"

namespace blush::test {

// Images have the channels that decoding gives them; distributions that no file measured are gone.
Project storable(Project project);

} // namespace blush::test
