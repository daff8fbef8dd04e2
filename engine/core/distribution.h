// Discrete distributions with exact probabilities: 32-bit integer thresholds are compared with the 32 random bits of the sampler,
// so that the reported probability of an index is exact. Inversion keeps the stratification of the points and returns a remapped
// random number for reuse.
#pragma once

#include "core/sampler.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

// Thresholds of a discrete distribution over `weights` (finite, >= 0): index i is drawn for random bits in
// [thresholds[i], thresholds[i + 1]); the last end, 2^32, is not stored. Every positive weight gets a probability of at least
// 2^-32, and so do zero weights at the end of the array. All weights 0: uniform. At most 2^24 weights.
std::vector<uint32_t> make_thresholds(std::span<const double> weights);

// Guide table (cutpoint method, Chen and Asau 1974): for each value of the leading `bits` (1 .. 24) of a random number the first
// index it may select, followed by the last index.
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
    // 2^32 wraps to 0: the difference is correct except for probability 1, which can only be the last index and gives 0.
    const UInt<F> span = high - low;
    const F p = to_float(to_signed(UInt<F>(span >> 8))) * 0x1p-24f + to_float(to_signed(UInt<F>(span & 255u))) * 0x1p-32f;
    return select(last && as_mask(span == UInt<F>(0u)), F(1.f), p);
}

// The sample for random bits that select a known index.
template <class F>
DiscreteSample<F> discrete_sample(const uint32_t* thresholds, const Int<F>& first, int n, const UInt<F>& bits, const Int<F>& index) {
    const F p = discrete_probability<F>(thresholds, first, Int<F>(n), index);
    const UInt<F> offset = bits - gather(thresholds, Int<F>(first + index));
    const F within = to_float(to_signed(UInt<F>(offset >> 8))) * 0x1p-24f + to_float(to_signed(UInt<F>(offset & 255u))) * 0x1p-32f;
    return {index, p, min(within / p, F(one_minus_epsilon))};
}

// Samples from the n thresholds at `first` (per lane) by bisection.
template <class F> DiscreteSample<F> sample_discrete(const uint32_t* thresholds, const Int<F>& first, int n, const UInt<F>& bits) {
    Int<F> low = 0;
    // Largest index whose threshold is <= bits. In a run of equal thresholds only the last index has a probability > 0.
    for (int step = n > 1 ? int(std::bit_floor(unsigned(n - 1))) : 0; step > 0; step >>= 1) {
        const Int<F> probe = min(Int<F>(low + step), Int<F>(n - 1));
        const Mask<F> below = as_mask(gather(thresholds, Int<F>(first + probe)) <= bits);
        low = select(below, probe, low);
    }
    return discrete_sample<F>(thresholds, first, n, bits, low);
}

// The same for tables larger than the cache: bisects only the range that the guide table at `first_guide` (per lane) gives.
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
