// Discrete distributions with exact probabilities: thresholds are 32-bit integers compared with the sampler's 32 random bits,
// so the probability that an index is drawn is exactly the one reported. Inversion keeps the points' stratification,
// and what is left of the random number is handed back for reuse.
#pragma once

#include "core/sampler.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// Thresholds of a discrete distribution over `weights` (finite, >= 0): index i is drawn for random bits in
// [thresholds[i], thresholds[i + 1]); the last end, 2^32, is not stored. Every positive weight gets at least one 2^32-th, and
// so do zero weights at the very end. All weights 0: the uniform distribution. At most 2^24 weights.
std::vector<uint32_t> make_thresholds(std::span<const double> weights);

// For each of the 2^bits values of the leading `bits` (1 .. 24) of a random number the first index it may draw, and after them
// the last index of all: where to search (cutpoint method, Chen and Asau 1974).
std::vector<int32_t> make_guide(std::span<const uint32_t> thresholds, int bits);

} // namespace blush

namespace blush::inline BLUSH_ISA {

template <class F> struct DiscreteSample {
    Int<F> index;
    F probability;
    F remainder; // uniform in [0, 1), independent of the index
};

// Probability of `index` under thresholds[0 .. n).
template <class F> F discrete_probability(const uint32_t* thresholds, const Int<F>& first, const Int<F>& n, const Int<F>& index) {
    const UInt<F> low = gather(thresholds, Int<F>(first + index));
    const Mask<F> last = as_mask(index + 1 >= n);
    const UInt<F> high = select(last, UInt<F>(0u), gather(thresholds, Int<F>(first + min(Int<F>(index + 1), Int<F>(n - 1)))));
    // 2^32 wraps to 0: the difference is right but for a certain event, which can only be the last index and reads 0.
    const UInt<F> span = high - low;
    const F p = to_float(to_signed(UInt<F>(span >> 8))) * 0x1p-24f + to_float(to_signed(UInt<F>(span & 255u))) * 0x1p-32f;
    return select(last && as_mask(span == UInt<F>(0u)), F(1.f), p);
}

// What random bits draw, once it is known on which index they fall.
template <class F>
DiscreteSample<F> discrete_sample(const uint32_t* thresholds, const Int<F>& first, int n, const UInt<F>& bits, const Int<F>& index) {
    const F p = discrete_probability<F>(thresholds, first, Int<F>(n), index);
    const UInt<F> offset = bits - gather(thresholds, Int<F>(first + index));
    const F within = to_float(to_signed(UInt<F>(offset >> 8))) * 0x1p-24f + to_float(to_signed(UInt<F>(offset & 255u))) * 0x1p-32f;
    return {index, p, min(within / p, F(one_minus_epsilon))};
}

// Draws from the n thresholds at `first` (per lane) by bisection.
template <class F> DiscreteSample<F> sample_discrete(const uint32_t* thresholds, const Int<F>& first, int n, const UInt<F>& bits) {
    Int<F> low = 0;
    // Largest index whose threshold is <= bits. Of a run of equal thresholds the last is the one with any probability.
    for (int step = n > 1 ? int(std::bit_floor(unsigned(n - 1))) : 0; step > 0; step >>= 1) {
        const Int<F> probe = min(Int<F>(low + step), Int<F>(n - 1));
        const Mask<F> below = as_mask(gather(thresholds, Int<F>(first + probe)) <= bits);
        low = select(below, probe, low);
    }
    return discrete_sample<F>(thresholds, first, n, bits, low);
}

// The same draw where thresholds are too many for the cache: bisects only what the guide at `first_guide` (per lane) leaves.
template <class F> DiscreteSample<F> sample_guided(const uint32_t* thresholds, const Int<F>& first, int n, const int32_t* guide,
                                                   const Int<F>& first_guide, int guide_bits, const UInt<F>& bits) {
    const Int<F> at = first_guide + to_signed(UInt<F>(bits >> (32 - guide_bits)));
    Int<F> low = gather(guide, at), high = gather(guide, Int<F>(at + 1));
    while (any(as_mask(low < high))) {
        const Int<F> probe = (low + high + 1) >> 1;
        const Mask<F> below = as_mask(gather(thresholds, Int<F>(first + probe)) <= bits);
        low = select(below, probe, low);
        high = select(below, high, Int<F>(probe - 1));
    }
    return discrete_sample<F>(thresholds, first, n, bits, low);
}

} // namespace blush::inline BLUSH_ISA
