// IEEE 754 half precision for non-negative numbers: 11 significant bits from 2^-14 to 65504, fewer down to 2^-24.
#pragma once

#include "core/lanes.h"

namespace blush {

// Bits of the nearest half, ties to even; larger values are clamped to 65504. x >= 0.
inline uint32_t half_bits(float x) {
    if (!(x < 65504.f)) return 0x7bff;
    if (x < 0x1p-14f) return uint32_t(std::lrint(x * 0x1p24f));
    const uint32_t bits = std::bit_cast<uint32_t>(x);
    return ((bits + 0xfff + (bits >> 13 & 1)) >> 13) - (112u << 10);
}

} // namespace blush

namespace blush::inline BLUSH_ISA {

// Value of the low 15 bits. Exact even if denormals are flushed to zero.
template <class F> F half_value(const Int<F>& bits) {
    const Int<F> shifted = bits << 13;
    const F normal = float_from_bits(Int<F>(shifted + (112 << 23)));
    const F below = float_from_bits(Int<F>(shifted + (113 << 23))) - 0x1p-14f;
    return select(as_mask(bits < 1024), below, normal);
}

} // namespace blush::inline BLUSH_ISA
