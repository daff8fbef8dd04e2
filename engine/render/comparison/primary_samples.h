// Primary sample space: the random numbers of a path as a point of the unit cube, and its mutations (Kelemen, Szirmay-Kalos, Antal and
// Csonka 2002, "A simple and robust mutation strategy for the Metropolis light transport algorithm").
#pragma once

#include "render/comparison/random_pairs.h"

#include <array>
#include <cstdint>
#include <random>
#include <unordered_map>

namespace blush {

class PrimarySamples : public RandomPairs {
public:
    // A dimension that small steps leave as it is: for what small steps cannot change a little.
    static constexpr uint32_t fixed_dimension = ~0u;

    // A point of the unit cube, and the mutations of this seed.
    explicit PrimarySamples(uint64_t seed);

    Pair<float> pair(uint32_t dimension) override;
    // Mutates the point: all numbers anew, or each moved a little.
    void mutate(bool large);
    // Takes back the last mutation; at most once for each.
    void reject();
    // Uniform in [0, 1), for decisions about mutations.
    double random();

private:
    // A number in units of 2^-32, brought up to the present mutation when it is read.
    struct Number {
        uint32_t value = 0, before = 0;            // before: to which reject() goes back
        int64_t changed = -1, changed_before = -1; // mutation; -1: never
    };
    void bring_up(Number& number, bool fixed);
    uint32_t moved(uint32_t value);

    std::mt19937 engine_;
    std::unordered_map<uint32_t, std::array<Number, 2>> numbers_; // by dimension
    int64_t mutation_ = 0, last_large_ = 0, last_large_before_ = 0;
};

} // namespace blush
