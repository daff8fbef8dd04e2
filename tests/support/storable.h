// Reduces a project to what files can store, for tests with random edits.
#pragma once

#include "scene/document/edit.h"

namespace blush::test {

// Images have the channels that decoding gives them; IES profiles that were not loaded from a file are removed.
Project storable(Project project);

} // namespace blush::test
