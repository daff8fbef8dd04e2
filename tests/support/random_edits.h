// Valid random edits of every kind, for tests that compare two ways to reach the same state.
#pragma once

#include "scene/document/edit.h"

#include <random>

namespace blush::test {

using Rng = std::mt19937;

// An edit of kind `kind` (an index into Edit's alternatives) with random parameters that apply() accepts. Null if the project has
// no target for this kind (no light left, say).
std::optional<Edit> random_edit(Rng& rng, const Project& project, size_t kind);
// Any kind that the project allows.
Edit random_edit(Rng& rng, const Project& project);

} // namespace blush::test
