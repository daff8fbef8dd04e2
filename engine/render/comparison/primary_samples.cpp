#include "render/comparison/primary_samples.h"

#include <cmath>

namespace blush {
namespace {

// Distances of small steps, of the unit interval: exponential between these (Kelemen et al. 2002, section 4).
constexpr double smallest_step = 1.0 / 1024, largest_step = 1.0 / 64;

} // namespace

PrimarySamples::PrimarySamples(uint64_t seed) {
    std::seed_seq words{uint32_t(seed), uint32_t(seed >> 32)};
    engine_.seed(words);
}

double PrimarySamples::random() { return double(engine_()) * 0x1p-32; }

uint32_t PrimarySamples::moved(uint32_t value) {
    const double distance = largest_step * std::exp(-std::log(largest_step / smallest_step) * random());
    const auto step = uint32_t(distance * 0x1p32);
    return engine_() & 1u ? value + step : value - step; // wraps around the unit interval
}

// Numbers that the mutations since have not read are changed by all of them now.
void PrimarySamples::bring_up(Number& number, bool fixed) {
    if (number.changed == mutation_) return;
    number.before = number.value;
    number.changed_before = number.changed;
    if (number.changed < last_large_) {
        number.value = engine_();
        number.changed = last_large_;
    }
    for (; number.changed < mutation_; ++number.changed)
        if (!fixed) number.value = moved(number.value);
}

Pair<float> PrimarySamples::pair(uint32_t dimension) {
    std::array<Number, 2>& numbers = numbers_[dimension];
    for (Number& number : numbers) bring_up(number, dimension == fixed_dimension);
    return {numbers[0].value, numbers[1].value};
}

void PrimarySamples::mutate(bool large) {
    ++mutation_;
    last_large_before_ = last_large_;
    if (large) last_large_ = mutation_;
}

void PrimarySamples::reject() {
    for (auto& [dimension, numbers] : numbers_)
        for (Number& number : numbers)
            if (number.changed == mutation_) number.value = number.before, number.changed = number.changed_before;
    last_large_ = last_large_before_;
    --mutation_;
}

} // namespace blush
