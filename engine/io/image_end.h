// Does a JPEG or PNG file reach its end marker?
//
// The question is answered before a decoder sees the bytes: libjpeg fills in the missing part of a truncated file with grey
// and only warns; at the end of a truncated PNG, OpenImageIO's reader leaks. JPEG markers: ITU-T T.81, annex B; PNG chunks:
// ISO/IEC 15948, clause 5.
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

// Walks from chunk to chunk: big-endian length, type, that many bytes, checksum.
inline bool png_reaches_its_end(std::span<const uint8_t> bytes) {
    constexpr size_t signature = 8, around_data = 12;
    size_t i = signature;
    while (i + around_data <= bytes.size()) {
        const uint8_t* c = bytes.data() + i;
        const size_t length = size_t(c[0]) << 24 | size_t(c[1]) << 16 | size_t(c[2]) << 8 | size_t(c[3]);
        if (length > bytes.size() - i - around_data) return false;
        if (c[4] == 'I' && c[5] == 'E' && c[6] == 'N' && c[7] == 'D') return true;
        i += around_data + length;
    }
    return false;
}

} // namespace blush
