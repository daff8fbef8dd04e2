// Sampler: stateless Owen-scrambled Sobol points, a function of (pixel, sample, dimension, seed).
// Pairs of dimensions are padded: each pair is the (0,2)-sequence of Sobol's first two dimensions, its index shuffled
// and its values scrambled by hashes of the key (Burley 2020, "Practical Hash-based Owen Scrambling"; hash of Vegdahl 2021).
#pragma once

#include "core/math.h"

namespace blush::inline BLUSH_ISA {

// PCG output permutation as a hash of 32 bits (Jarzynski and Olano 2020); a bijection.
template <class U> U pcg_hash(U v) {
    const U s = v * 747796405u + 2891336453u;
    const U w = ((s >> ((s >> 28u) + 4u)) ^ s) * 277803737u;
    return (w >> 22u) ^ w;
}

// [0, 1) from the upper 24 bits.
template <class F> F unit_float(const UInt<F>& x) { return to_float(to_signed(UInt<F>(x >> 8))) * 0x1p-24f; }

template <class U> U reverse_bits(U x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}
// Owen scrambling of a bit-reversed number: each bit is flipped by a hash of the bits below it.
template <class U> U scramble_reversed(U x, U seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}
// Second Sobol dimension of a bit-reversed index, bit-reversed: multiplication by the Pascal matrix mod 2.
template <class U> U sobol1_reversed(U i) {
    i ^= (i & 0xaaaaaaaau) >> 1;
    i ^= (i & 0xccccccccu) >> 2;
    i ^= (i & 0xf0f0f0f0u) >> 4;
    i ^= (i & 0xff00ff00u) >> 8;
    i ^= (i & 0xffff0000u) >> 16;
    return i;
}

template <class F> struct Pair {
    UInt<F> bits_x, bits_y; // uniform in all 32 bits
    F x() const { return unit_float<F>(bits_x); }
    F y() const { return unit_float<F>(bits_y); }
};

template <class F> struct Sampler {
    UInt<F> key;   // pixel_key(...)
    UInt<F> index; // within the randomisation

    // The `dimension`-th pair of coordinates of this point.
    Pair<F> pair(uint32_t dimension) const {
        const UInt<F> seed = pcg_hash(UInt<F>(key + dimension * 0x9e3779b9u));
        const UInt<F> i = reverse_bits(scramble_reversed(reverse_bits(index), seed));
        return {reverse_bits(scramble_reversed(i, pcg_hash(UInt<F>(seed ^ 0x85ebca6bu)))),
                reverse_bits(scramble_reversed(sobol1_reversed(i), pcg_hash(UInt<F>(seed ^ 0xc2b2ae35u))))};
    }
};

// Key of a pixel for one randomisation of the sampler. Each pixel uses two independent randomisations (A/B buffers), whose
// difference measures the error: sample s is point s / 2 of randomisation s % 2.
inline uint32_t randomisation(uint32_t seed, uint32_t half) { return pcg_hash(pcg_hash(seed) ^ (half * 0x68e31da4u)); }
template <class F> UInt<F> pixel_key(const UInt<F>& x, const UInt<F>& y, const UInt<F>& randomisation) {
    return pcg_hash(UInt<F>(pcg_hash(UInt<F>(x ^ randomisation)) + y));
}

// Independent random numbers instead of stratified points: each sample has its own key and uses point 0.
template <class U> U independent_key(const U& key, const U& sample) { return pcg_hash(U(pcg_hash(U(sample ^ 0x5bd1e995u)) ^ key)); }

} // namespace blush::inline BLUSH_ISA
