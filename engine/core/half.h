// IEEE 754 half precision, of numbers from 0 on: 11 significant bits from 2^-14 to 65504, fewer down to 2^-24.
#pragma once

#include "core/lanes.h"

namespace blush {

// Bits of the nearest half, to even from the middle; what is above 65504 becomes that. x is a number from 0 on.
inline uint32_t half_bits(float x) {
    if (!(x < 65504.f)) return 0x7bff;
    if (x < 0x1p-14f) return uint32_t(std::lrint(x * 0x1p24f));
    const uint32_t bits = std::bit_cast<uint32_t>(x);
    return ((bits + 0xfff + (bits >> 13 & 1)) >> 13) - (112u << 10);
}

} // namespace blush

namespace blush::inline BLUSH_ISA {

// The number that the low 15 bits are. Exact where denormals are flushed to zero, too.
template <class F> F half_value(const Int<F>& bits) {
    const Int<F> shifted = bits << 13;
    const F normal = float_from_bits(Int<F>(shifted + (112 << 23)));
    const F below = float_from_bits(Int<F>(shifted + (113 << 23))) - 0x1p-14f;
    return select(as_mask(bits < 1024), below, normal);
}

} // namespace blush::inline BLUSH_ISA
