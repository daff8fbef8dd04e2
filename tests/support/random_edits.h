// Valid random edits of every kind, for tests that compare two ways to the same place.
#pragma once

#include "scene/edit.h"

#include <random>

namespace blush::test {

using Rng = std::mt19937;

// Kind `kind` (an index into Edit's alternatives) of edit, with random parameters, that apply() accepts. Null if the project has nothing
// for this kind to act upon (no light left, say).
std::optional<Edit> random_edit(Rng& rng, const Project& project, size_t kind);
// Any kind that the project allows.
Edit random_edit(Rng& rng, const Project& project);

} // namespace blush::test
