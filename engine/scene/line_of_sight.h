// What stands between two points: one question at a time, for whoever has no rays.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <optional>

namespace blush {

// The visible object that the straight line from one point to another meets first, among those that `counts`; none where it meets nothing.
// What lets light through, as glass or by its alpha, is not met. A
// ten-thousandth of the line at either end is left out, which is where the surfaces are that it begins and ends on. Looks at every triangle of
// what the line may meet: milliseconds for a million.
std::optional<Id<Node>> first_between(const Scene& scene, const Vec3d& from, const Vec3d& to, const std::function<bool(Id<Node>)>& counts);

} // namespace blush
