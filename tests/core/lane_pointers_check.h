// Reads words through pointers of lanes, compiled for one instruction set.
#pragma once

#include "core/lane_pointers.h"

#include <cstring>

namespace blush::inline BLUSH_ISA {

// Lane i reads the word at `words + 4 i` if it is active; the others have pointers that must not be read. True if the active lanes have
// their word and the others 0.
template <class F> bool reads_only_active_lanes(const char* words, const void* unreadable) {
    struct Record {
        const void* pointer;
    } records[width<F>];
    bool right = true;
    for (const unsigned active : {0x5555u, 0xaaaau, 0x00ffu, 0xff01u, 0u, 0xffffu}) {
        for (int i = 0; i < width<F>; ++i) records[i].pointer = active >> i & 1 ? words : unreadable;
        const Pointers<F> p = gather_pointers<F>(records, &Record::pointer, iota<F>());
        const Mask<F> lanes = as_mask((Int<F>(int32_t(active)) & (Int<F>(1) << iota<F>())) != 0);
        const UInt<F> read = gather_words(p, to_unsigned(Int<F>(iota<F>() * 4)), lanes);
        for (int i = 0; i < width<F>; ++i) {
            uint32_t word = 0;
            if (active >> i & 1) std::memcpy(&word, words + 4 * i, sizeof word);
            right = right && uint32_t(lane(to_signed(read), i)) == word;
        }
    }
    return right;
}

} // namespace blush::inline BLUSH_ISA
