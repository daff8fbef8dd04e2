// Sampler: stateless Owen-scrambled Sobol points, a function of (pixel, sample, dimension, seed).
// Pairs of dimensions are padded: each pair is the (0,2)-sequence of Sobol's first two dimensions, its index shuffled
// and its values scrambled by hashes of the key (Burley 2020, "Practical Hash-based Owen Scrambling"; hash of Vegdahl 2021).
//
// The pixels of a block of 8 x 8 share the key. Each has the block's sequence plus (XOR) an offset of its own, in its place in Z-order
// (Ahmed and Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels").
// Any one pixel has a scrambled Sobol sequence, neighbours have complementary points: their errors tend to cancel.
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

// Pixels in a block: 2^block_bits squared. The place of a pixel in its block is the upper 6 bits of the index of its points.
constexpr int block_bits = 3, place_bits = 2 * block_bits, place_shift = 32 - place_bits;
constexpr uint32_t place_mask = (1u << place_bits) - 1;

// Offsets of the first (lower half) and second dimension (upper half), to a bit-reversed place, bit-reversed. With these columns,
// found by search, all first 2^b points of all pixels of an aligned square of 2 x 2, 4 x 4 or 8 x 8 are together a (0,m,2)-net in base
// 2, for all b up to 10. No columns do that for the halves of a square.
template <class U> U place_offset(const U& place) {
    constexpr uint32_t columns[place_bits] = {0x797e6e97, 0x83b8d2fd, 0xb8a2df3c, 0xa4518514, 0x0b6d7db6, 0xc6db76db};
    U offset = U(0u);
    for (int bit = 0; bit < place_bits; ++bit) offset ^= (U(0u) - ((place >> bit) & 1u)) & columns[bit];
    return offset;
}

template <class F> struct Pair {
    UInt<F> bits_x, bits_y; // uniform in all 32 bits
    F x() const { return unit_float<F>(bits_x); }
    F y() const { return unit_float<F>(bits_y); }
};

template <class F> struct Sampler {
    UInt<F> key;   // of the block and the randomisation
    UInt<F> index; // within the randomisation; the place in the block is its upper 6 bits

    // The `dimension`-th pair of coordinates of this point.
    Pair<F> pair(uint32_t dimension) const {
        const UInt<F> seed = pcg_hash(UInt<F>(key + dimension * 0x9e3779b9u));
        const UInt<F> reversed = reverse_bits(index);
        const UInt<F> place = scramble_reversed(UInt<F>(reversed & place_mask), pcg_hash(UInt<F>(seed ^ 0x27d4eb2fu)));
        const UInt<F> offset = place_offset(place);
        const UInt<F> i = reverse_bits(scramble_reversed(UInt<F>(reversed & ~place_mask), seed));
        const UInt<F> x = i ^ (offset & 0xffffu), y = sobol1_reversed(i) ^ (offset >> 16);
        return {reverse_bits(scramble_reversed(x, pcg_hash(UInt<F>(seed ^ 0x85ebca6bu)))),
                reverse_bits(scramble_reversed(y, pcg_hash(UInt<F>(seed ^ 0xc2b2ae35u))))};
    }
};

// Key for one randomisation of the sampler. Each pixel uses two independent randomisations (A/B buffers), whose
// difference measures the error: sample s is point s / 2 of randomisation s % 2.
inline uint32_t randomisation(uint32_t seed, uint32_t half) { return pcg_hash(pcg_hash(seed) ^ (half * 0x68e31da4u)); }
template <class F> UInt<F> pixel_key(const UInt<F>& x, const UInt<F>& y, const UInt<F>& randomisation) {
    return pcg_hash(UInt<F>(pcg_hash(UInt<F>(x ^ randomisation)) + y));
}
// Point `index` of a pixel. A pixel has 2^26 points of one sequence, then those of another.
template <class F> Sampler<F> pixel_sampler(const UInt<F>& x, const UInt<F>& y, const UInt<F>& randomisation, const UInt<F>& index) {
    UInt<F> place = UInt<F>(0u);
    for (int bit = 0; bit < block_bits; ++bit) place |= (((x >> bit) & 1u) << (2 * bit)) | (((y >> bit) & 1u) << (2 * bit + 1));
    const UInt<F> sequence = randomisation + (index >> place_shift);
    return {pixel_key<F>(x >> block_bits, y >> block_bits, sequence), (index & ~(place_mask << place_shift)) | (place << place_shift)};
}

// Independent random numbers instead of stratified points: each sample has its own key and uses point 0.
template <class F> Sampler<F> independent_sampler(const UInt<F>& x, const UInt<F>& y, const UInt<F>& randomisation, const UInt<F>& index) {
    const UInt<F> key = pcg_hash(UInt<F>(pcg_hash(UInt<F>(index ^ 0x5bd1e995u)) ^ pixel_key<F>(x, y, randomisation)));
    return {key, UInt<F>(0u)};
}

} // namespace blush::inline BLUSH_ISA
