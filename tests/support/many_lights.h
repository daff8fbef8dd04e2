// A house with ten thousand lamps, and what it costs to choose among them one way or another.
#pragma once

#include "render/scene_tables.h"
#include "scene/scene.h"

namespace blush::test {

// `rooms` x `rooms` rooms of 4 m with 25 lamps each below where the ceiling would be, of all strengths, half of them points and half downlights.
Scene house(int rooms);

// Relative variances of one light sample, on average over receivers on floors and walls. They follow from the probabilities alone: the sum of
// V c^2 / p over the square of the sum of V c, minus 1, where c is what a lamp gives if nothing is between and V whether it is in the
// receiver's room. The oracle asks all lamps and takes p proportional to c; power sampling knows no receiver.
struct ChoiceVariance {
    double oracle = 0, tree = 0, power = 0;
};
ChoiceVariance choice_variance(const SceneTables& tables, int rooms, int receivers);

// Mean variance of the pixels of a picture that looks down on nine rooms in the middle, direct light at `spp` samples per pixel: as it is
// rendered, told from two seeds, and what it would be with one light drawn for each sample by the oracle, or by power.
struct ImageVariance {
    double oracle = 0, rendered = 0, power = 0;
};
ImageVariance image_variance(int rooms, int64_t spp);

} // namespace blush::test
