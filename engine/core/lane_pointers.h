// A pointer per lane, for data that no common array holds. Uses intrinsics, as lanes.h does.
#pragma once

#include "core/lanes.h"

#include <array>

namespace blush::inline BLUSH_ISA {

template <class F> struct Pointers;
template <> struct Pointers<float> { const char* address; };
template <> struct Pointers<Wide> {
#if defined(__AVX512F__)
    __m512i low, high; // of the first and the last eight lanes
#elif defined(__AVX2__)
    __m256i low, high; // of the first and the last four lanes
#else
    std::array<const char*, width<Wide>> address;
#endif
};

// records[i].*field; i must be valid in every lane.
template <class F, class Record> Pointers<F> gather_pointers(const Record* records, const void* Record::*field, const Int<F>& i) {
    if constexpr (std::is_same_v<F, float>)
        return {static_cast<const char*>(records[i].*field)};
    else {
        static_assert(sizeof(Record) % sizeof(void*) == 0);
        Pointers<F> p;
#if defined(__AVX512F__)
        const auto at = __m512i(Int<F>(i * int32_t(sizeof(Record) / sizeof(void*))));
        p.low = _mm512_i32gather_epi64(_mm512_castsi512_si256(at), &(records->*field), 8);
        p.high = _mm512_i32gather_epi64(_mm512_extracti64x4_epi64(at, 1), &(records->*field), 8);
#elif defined(__AVX2__)
        const auto at = __m256i(Int<F>(i * int32_t(sizeof(Record) / sizeof(void*))));
        const auto* first = reinterpret_cast<const long long*>(&(records->*field));
        p.low = _mm256_i32gather_epi64(first, _mm256_castsi256_si128(at), 8);
        p.high = _mm256_i32gather_epi64(first, _mm256_extracti128_si256(at, 1), 8);
#else
        for (int k = 0; k < width<F>; ++k) p.address[size_t(k)] = static_cast<const char*>(records[i[size_t(k)]].*field);
#endif
        return p;
    }
}

// The four bytes at this offset from each pointer, which need no alignment. Only active lanes are read, the others are 0.
inline uint32_t gather_words(const Pointers<float>& p, uint32_t offset, bool active) {
    uint32_t word = 0;
    if (active) std::memcpy(&word, p.address + offset, sizeof word);
    return word;
}
inline WideUInt gather_words(const Pointers<Wide>& p, WideUInt offset, WideMask active) {
#if defined(__AVX512F__)
    const auto o = __m512i(offset);
    const __m512i low = _mm512_add_epi64(p.low, _mm512_cvtepu32_epi64(_mm512_castsi512_si256(o)));
    const __m512i high = _mm512_add_epi64(p.high, _mm512_cvtepu32_epi64(_mm512_extracti64x4_epi64(o, 1)));
    const __m256i zero = _mm256_setzero_si256();
    const unsigned lanes = bits(active);
    const __m512i words = _mm512_castsi256_si512(_mm512_mask_i64gather_epi32(zero, __mmask8(lanes & 0xffu), low, nullptr, 1));
    return WideUInt(_mm512_inserti64x4(words, _mm512_mask_i64gather_epi32(zero, __mmask8(lanes >> 8), high, nullptr, 1), 1));
#elif defined(__AVX2__)
    const auto o = __m256i(offset);
    const __m256i low = _mm256_add_epi64(p.low, _mm256_cvtepu32_epi64(_mm256_castsi256_si128(o)));
    const __m256i high = _mm256_add_epi64(p.high, _mm256_cvtepu32_epi64(_mm256_extracti128_si256(o, 1)));
    const auto all = __m256i(WideInt(select(active, WideInt(-1), WideInt(0))));
    const __m128i zero = _mm_setzero_si128();
    const int* null = nullptr;
    return WideUInt(_mm256_set_m128i(_mm256_mask_i64gather_epi32(zero, null, high, _mm256_extracti128_si256(all, 1), 1),
                                     _mm256_mask_i64gather_epi32(zero, null, low, _mm256_castsi256_si128(all), 1)));
#else
    return WideUInt([&](auto k) { return gather_words(Pointers<float>{p.address[k]}, offset[k], active[k]); });
#endif
}

} // namespace blush::inline BLUSH_ISA
