// Interpolates keyframes (glTF 2.0, appendix C).
#pragma once

#include "core/vec.h"
#include "scene/animation/animation.h"

#include <span>
#include <vector>

namespace blush {

// Number of floats in one value.
size_t width_of(const Keyframes& keyframes);

// The value at `seconds`, interpolated by component. Constant before the first keyframe and after the last. Tangents of cubic
// splines are per second.
std::vector<float> value_at(const Keyframes& keyframes, float seconds);
// The same for unit quaternions (four floats per value): linear interpolation is spherical (slerp), along the shorter arc.
Quat rotation_at(const Keyframes& keyframes, float seconds);

} // namespace blush
