// Does a JPEG file reach its end-of-image marker?
//
// libjpeg fills in the missing part of a truncated file with grey and only warns, so the question is answered before it
// sees the bytes. Markers: ITU-T T.81, annex B.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace blush {

// Walks from segment to segment; a thumbnail inside a segment, which has an end marker of its own, is skipped with it.
inline bool jpeg_reaches_its_end(std::span<const uint8_t> bytes) {
    constexpr uint8_t end_of_image = 0xd9, first_standalone = 0xd0, last_standalone = 0xd8, temporary = 0x01;
    size_t i = 0;
    while (i + 1 < bytes.size()) {
        const uint8_t marker = bytes[i + 1];
        // Between markers: entropy-coded data, in which 0xff is followed by 0x00; 0xff itself may be repeated as fill.
        if (bytes[i] != 0xff || marker == 0x00 || marker == 0xff) {
            ++i;
            continue;
        }
        if (marker == end_of_image) return true;
        if ((marker >= first_standalone && marker <= last_standalone) || marker == temporary) {
            i += 2;
            continue;
        }
        if (i + 3 >= bytes.size()) return false;
        i += 2 + size_t(bytes[i + 2] << 8 | bytes[i + 3]);
    }
    return false;
}

} // namespace blush
