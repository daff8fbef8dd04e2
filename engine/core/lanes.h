// SIMD lanes: "a number per path". F is float (one path, the reference in tests) or Wide, a SIMD register. Shading is templated
// on F: `select` replaces if, and `if (any(mask))` skips work that no lane needs. Only this file, core/block.h and
// core/lane_pointers.h use intrinsics, for what std::experimental::simd lacks: gather, compress, shifts of lanes.
#pragma once

#include "core/isa.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <experimental/simd>
#include <immintrin.h>
#include <type_traits>

namespace blush::inline BLUSH_ISA {

namespace stdx = std::experimental;
using Wide = stdx::native_simd<float>;

template <class F> struct Lanes;
template <> struct Lanes<float> {
    using Int = int32_t;
    using UInt = uint32_t;
    using Mask = bool;
    static constexpr int width = 1;
};
template <> struct Lanes<Wide> {
    using Int = stdx::rebind_simd_t<int32_t, Wide>;
    using UInt = stdx::rebind_simd_t<uint32_t, Wide>;
    using Mask = Wide::mask_type;
    static constexpr int width = int(Wide::size());
};
template <class F> using Int = typename Lanes<F>::Int;
template <class F> using UInt = typename Lanes<F>::UInt;
template <class F> using Mask = typename Lanes<F>::Mask;
template <class F> inline constexpr int width = Lanes<F>::width;
using WideInt = Int<Wide>;
using WideUInt = UInt<Wide>;
using WideMask = Mask<Wide>;

// ---- masks
inline bool any(bool m) { return m; }
inline bool all(bool m) { return m; }
inline bool any(WideMask m) { return stdx::any_of(m); }
inline bool all(WideMask m) { return stdx::all_of(m); }
// Bit i is lane i.
inline unsigned bits(bool m) { return m; }
inline unsigned bits(WideMask m) {
    const auto mask = m.__to_bitset().to_ulong();
#if defined(__AVX512F__) && !defined(__clang__)
    // GCC 12 may store a mask as 16 bits and load it as 32, with what lies behind it on the stack. This instruction clears the others.
    unsigned all;
    asm("kmovw %1, %0" : "=r"(all) : "k"(static_cast<unsigned short>(mask)));
    return all;
#else
    return unsigned(mask);
#endif
}
inline int count(bool m) { return m; }
inline int count(WideMask m) { return std::popcount(bits(m)); }
// Converts a mask of integers to a mask of F.
inline bool as_mask(bool m) { return m; }
template <class T, class A> WideMask as_mask(stdx::simd_mask<T, A> m) { return stdx::__proposed::static_simd_cast<WideMask>(m); }

// ---- select: a where m, else b
template <class T>
requires std::is_arithmetic_v<T> T select(bool m, T a, T b) { return m ? a : b; }
#if defined(__AVX512F__) && defined(__clang__)
// With Clang 16, where() of libstdc++ 12 assigns the lanes that the mask leaves out.
inline __mmask16 mmask(WideMask m) { return __mmask16(m.__to_bitset().to_ulong()); }
inline Wide select(WideMask m, Wide a, Wide b) { return Wide(_mm512_mask_blend_ps(mmask(m), __m512(b), __m512(a))); }
inline WideInt select(WideMask m, WideInt a, WideInt b) { return WideInt(_mm512_mask_blend_epi32(mmask(m), __m512i(b), __m512i(a))); }
inline WideUInt select(WideMask m, WideUInt a, WideUInt b) { return WideUInt(_mm512_mask_blend_epi32(mmask(m), __m512i(b), __m512i(a))); }
#else
inline Wide select(WideMask m, Wide a, Wide b) {
    stdx::where(m, b) = a;
    return b;
}
inline WideInt select(WideMask m, WideInt a, WideInt b) {
    stdx::where(stdx::__proposed::static_simd_cast<WideInt::mask_type>(m), b) = a;
    return b;
}
inline WideUInt select(WideMask m, WideUInt a, WideUInt b) {
    stdx::where(stdx::__proposed::static_simd_cast<WideUInt::mask_type>(m), b) = a;
    return b;
}
#endif
inline bool select(bool m, bool a, bool b) { return m ? a : b; }
inline WideMask select(WideMask m, WideMask a, WideMask b) { return (m && a) || (!m && b); }

// ---- arithmetic
inline float sqrt(float x) { return __builtin_sqrtf(x); }
inline float abs(float x) { return __builtin_fabsf(x); }
inline float floor(float x) { return __builtin_floorf(x); }
inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }
inline int32_t min(int32_t a, int32_t b) { return a < b ? a : b; }
inline int32_t max(int32_t a, int32_t b) { return a > b ? a : b; }
inline uint32_t min(uint32_t a, uint32_t b) { return a < b ? a : b; }
inline Wide sqrt(Wide x) { return stdx::sqrt(x); }
inline Wide abs(Wide x) { return stdx::abs(x); }
inline Wide floor(Wide x) { return stdx::floor(x); }
// As for float: b where either is NaN, or if they are equal.
#if defined(__AVX512F__)
inline Wide min(Wide a, Wide b) { return Wide(_mm512_min_ps(__m512(a), __m512(b))); }
inline Wide max(Wide a, Wide b) { return Wide(_mm512_max_ps(__m512(a), __m512(b))); }
#elif defined(__AVX__)
inline Wide min(Wide a, Wide b) { return Wide(_mm256_min_ps(__m256(a), __m256(b))); }
inline Wide max(Wide a, Wide b) { return Wide(_mm256_max_ps(__m256(a), __m256(b))); }
#else
inline Wide min(Wide a, Wide b) { return Wide(_mm_min_ps(__m128(a), __m128(b))); }
inline Wide max(Wide a, Wide b) { return Wide(_mm_max_ps(__m128(a), __m128(b))); }
#endif
inline WideInt min(WideInt a, WideInt b) { return stdx::min(a, b); }
inline WideInt max(WideInt a, WideInt b) { return stdx::max(a, b); }
inline bool is_finite(float x) { return abs(x) <= 3.402823466e38f; }
inline WideMask is_finite(Wide x) { return abs(x) <= 3.402823466e38f; }

// ---- conversions; float to int truncates towards zero
inline float to_float(int32_t i) { return float(i); }
inline Wide to_float(WideInt i) { return stdx::static_simd_cast<Wide>(i); }
inline int32_t to_int(float x) { return int32_t(x); }
// Lanes without a path may hold numbers that no int has, which C++ leaves undefined: the instruction gives INT_MIN.
#if defined(__AVX512F__)
inline WideInt to_int(Wide x) { return WideInt(_mm512_cvttps_epi32(__m512(x))); }
#elif defined(__AVX__)
inline WideInt to_int(Wide x) { return WideInt(_mm256_cvttps_epi32(__m256(x))); }
#else
inline WideInt to_int(Wide x) { return WideInt(_mm_cvttps_epi32(__m128(x))); }
#endif
inline int32_t to_signed(uint32_t x) { return int32_t(x); }
inline WideInt to_signed(WideUInt x) { return stdx::static_simd_cast<WideInt>(x); }
inline uint32_t to_unsigned(int32_t x) { return uint32_t(x); }
inline WideUInt to_unsigned(WideInt x) { return stdx::static_simd_cast<WideUInt>(x); }
inline int32_t float_bits(float x) { return std::bit_cast<int32_t>(x); }
inline float float_from_bits(int32_t x) { return std::bit_cast<float>(x); }
inline WideInt float_bits(Wide x) { return stdx::__proposed::simd_bit_cast<WideInt>(x); }
inline Wide float_from_bits(WideInt x) { return stdx::__proposed::simd_bit_cast<Wide>(x); }

// ---- lanes one by one
inline float lane(float x, int) { return x; }
inline int32_t lane(int32_t x, int) { return x; }
inline uint32_t lane(uint32_t x, int) { return x; }
template <class T, class A> T lane(const stdx::simd<T, A>& x, int i) { return x[size_t(i)]; }
// fn(i) for every lane set in `lanes` (from bits()), in order.
template <class Fn> void for_each_lane(unsigned lanes, Fn fn) {
    for (; lanes; lanes &= lanes - 1) fn(std::countr_zero(lanes));
}

// The order of the additions depends on the width.
inline float sum_lanes(Wide x) { return stdx::reduce(x); }

// ---- memory: n consecutive numbers starting at p, for n = width
template <class V, class T> V load(const T* p) {
    if constexpr (std::is_arithmetic_v<V>)
        return *p;
    else
        return V(p, stdx::element_aligned);
}
inline void store(float* p, float v) { *p = v; }
inline void store(int32_t* p, int32_t v) { *p = v; }
inline void store(uint32_t* p, uint32_t v) { *p = v; }
template <class T, class A> void store(T* p, stdx::simd<T, A> v) { v.copy_to(p, stdx::element_aligned); }
// 0, 1, 2, ... width - 1
template <class F> Int<F> iota() {
    if constexpr (std::is_same_v<F, float>)
        return 0;
    else
        return Int<F>([](auto i) { return int32_t(i); });
}

// ---- gather: p[i] per lane. i must be valid in every lane.
inline float gather(const float* p, int32_t i) { return p[i]; }
inline int32_t gather(const int32_t* p, int32_t i) { return p[i]; }
inline uint32_t gather(const uint32_t* p, int32_t i) { return p[i]; }
#if defined(__AVX512F__)
inline Wide gather(const float* p, WideInt i) { return Wide(_mm512_i32gather_ps(__m512i(i), p, 4)); }
inline WideInt gather(const int32_t* p, WideInt i) { return WideInt(_mm512_i32gather_epi32(__m512i(i), p, 4)); }
inline WideUInt gather(const uint32_t* p, WideInt i) { return WideUInt(_mm512_i32gather_epi32(__m512i(i), p, 4)); }
#elif defined(__AVX2__)
inline Wide gather(const float* p, WideInt i) { return Wide(_mm256_i32gather_ps(p, __m256i(i), 4)); }
inline WideInt gather(const int32_t* p, WideInt i) { return WideInt(_mm256_i32gather_epi32(p, __m256i(i), 4)); }
inline WideUInt gather(const uint32_t* p, WideInt i) {
    return WideUInt(_mm256_i32gather_epi32(reinterpret_cast<const int*>(p), __m256i(i), 4));
}
#else
inline Wide gather(const float* p, WideInt i) {
    return Wide([&](auto k) { return p[i[k]]; });
}
inline WideInt gather(const int32_t* p, WideInt i) {
    return WideInt([&](auto k) { return p[i[k]]; });
}
inline WideUInt gather(const uint32_t* p, WideInt i) {
    return WideUInt([&](auto k) { return p[i[k]]; });
}
#endif
// records[i].*field for records made of 4-byte fields, sizeof(Record) * i below 8 GiB.
template <class I, class Record, class T> auto gather_field(const Record* records, T Record::*field, I i) {
    static_assert(sizeof(Record) % 4 == 0 && sizeof(T) == 4);
    return gather(&(records->*field), i * int32_t(sizeof(Record) / 4));
}

// ---- compress: the lanes set in `lanes`, densely, to p; may write up to one register's worth beyond them
inline void compress(float* p, float v, unsigned) { *p = v; }
inline void compress(int32_t* p, int32_t v, unsigned) { *p = v; }
inline void compress(uint32_t* p, uint32_t v, unsigned) { *p = v; }
#if defined(__AVX512F__)
inline void compress(float* p, Wide v, unsigned lanes) { _mm512_storeu_ps(p, _mm512_maskz_compress_ps(__mmask16(lanes), __m512(v))); }
inline void compress(int32_t* p, WideInt v, unsigned lanes) {
    _mm512_storeu_si512(p, _mm512_maskz_compress_epi32(__mmask16(lanes), __m512i(v)));
}
inline void compress(uint32_t* p, WideUInt v, unsigned lanes) {
    _mm512_storeu_si512(p, _mm512_maskz_compress_epi32(__mmask16(lanes), __m512i(v)));
}
#else
template <class T, class A> void compress(T* p, const stdx::simd<T, A>& v, unsigned lanes) {
    for_each_lane(lanes, [&](int i) { *p++ = v[size_t(i)]; });
}
#endif

} // namespace blush::inline BLUSH_ISA
