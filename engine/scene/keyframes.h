// The value of keyframes at a moment: glTF 2.0, appendix C.
#pragma once

#include "core/vec.h"
#include "scene/motion.h"

#include <span>
#include <vector>

namespace blush {

// Floats in one value.
size_t width_of(const Keyframes& keyframes);

// At `seconds`, held before the first keyframe and after the last. Component by component; a spline's times its tangents are per second.
std::vector<float> value_at(const Keyframes& keyframes, float seconds);
// Of four floats per value, a unit quaternion: linear interpolation is spherical, by the shorter arc.
Quat rotation_at(const Keyframes& keyframes, float seconds);

} // namespace blush
