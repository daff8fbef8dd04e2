// A house with ten thousand lights, and the variance of light selection methods.
#pragma once

#include "render/compile/scene_tables.h"
#include "scene/scene.h"

namespace blush::test {

// `rooms` x `rooms` rooms of 4 m with 25 lights each below the (missing)
// ceiling, of various intensities, half of them points and half downlights.
Scene house(int rooms);

// Relative variances of one NEE sample, averaged over receivers on floors and walls. Computed from the probabilities alone: the
// sum of V c^2 / p over the square of the sum of V c, minus 1, where c is a light's unoccluded contribution and V whether it is
// in the receiver's room. The oracle evaluates all lights and uses p proportional to c; power sampling ignores the receiver.
struct SelectionVariance {
    double oracle = 0, tree = 0, power = 0;
};
SelectionVariance choice_variance(const SceneTables& tables, int rooms, int receivers);

// Mean variance of the pixels of an image of nine rooms in the middle from above, direct light at `spp` samples per pixel: as
// rendered, measured from two seeds, and computed for one light per sample selected by the oracle, or by power.
struct ImageVariance {
    double oracle = 0, rendered = 0, power = 0;
};
ImageVariance image_variance(int rooms, int64_t spp);

} // namespace blush::test
