// Blocks: sixteen numbers, whatever the width of a register, with sums whose bits do not depend on it.
// Uses intrinsics, as lanes.h does: std::experimental::simd cannot shift lanes.
#pragma once

#include "core/lanes.h"

namespace blush::inline BLUSH_ISA {

constexpr int block_size = 16, block_registers = block_size / width<Wide>;
static_assert(block_size % width<Wide> == 0);
struct Block {
    Wide v[block_registers];
};
inline void store(float* p, const Block& b) {
    for (int k = 0; k < block_registers; ++k) store(p + k * width<Wide>, b.v[k]);
}
// For each number the sum of itself and those before it (Hillis and Steele 1986). Every instruction set adds in the same order.
inline Block prefix_sums(const Block& x) {
#if defined(__AVX512F__)
    const __m512i zero = _mm512_setzero_si512();
    __m512 sum = __m512(x.v[0]);
    const auto add_shifted = [&](auto lanes) {
        sum = _mm512_add_ps(sum, _mm512_castsi512_ps(_mm512_alignr_epi32(_mm512_castps_si512(sum), zero, block_size - lanes)));
    };
    add_shifted(std::integral_constant<int, 1>());
    add_shifted(std::integral_constant<int, 2>());
    add_shifted(std::integral_constant<int, 4>());
    add_shifted(std::integral_constant<int, 8>());
    return {Wide(sum)};
#else
    alignas(64) float sums[2][block_size];
    store(sums[0], x);
    int now = 0;
    for (int step = 1; step < block_size; step *= 2, now = 1 - now) {
        for (int i = 0; i < step; ++i) sums[1 - now][i] = sums[now][i];
        for (int i = step; i < block_size; ++i) sums[1 - now][i] = sums[now][i] + sums[now][i - step];
    }
    Block all;
    for (int k = 0; k < block_registers; ++k) all.v[k] = load<Wide>(sums[now] + k * width<Wide>);
    return all;
#endif
}

} // namespace blush::inline BLUSH_ISA
