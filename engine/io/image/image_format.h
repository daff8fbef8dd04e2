// Detects the format of an image by its first bytes, and truncated JPEG and PNG files by their end marker.
// Checked before decoding: libjpeg fills the missing part of a truncated file with grey and only warns; OpenImageIO's PNG reader
// leaks memory. JPEG markers: ITU-T T.81, annex B; PNG chunks: ISO/IEC 15948, clause 5.
#pragma once

#include "core/result.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace blush {

// Walks the segments; skips thumbnails inside a segment, which have their own end marker.
inline bool is_complete_jpeg(std::span<const uint8_t> bytes) {
    constexpr uint8_t end_of_image = 0xd9, first_standalone = 0xd0, last_standalone = 0xd8, temporary = 0x01;
    size_t i = 0;
    while (i + 1 < bytes.size()) {
        const void* found = std::memchr(bytes.data() + i, 0xff, bytes.size() - i - 1);
        if (!found) return false;
        i = size_t(static_cast<const uint8_t*>(found) - bytes.data());
        const uint8_t marker = bytes[i + 1];
        // Entropy-coded data: 0xff is followed by 0x00; 0xff may be repeated as fill.
        if (marker == 0x00 || marker == 0xff) {
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

// Walks the chunks: big-endian length, type, data, checksum.
inline bool is_complete_png(std::span<const uint8_t> bytes) {
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

// "png", "jpeg", "openexr", "hdr", "webp" or "bmp", as OpenImageIO calls them. The only decoders that are used: reduces the attack
// surface, and special names such as "x.null" have no effect. TIFF is excluded since its decoder fills truncated files with black and
// reports success. Errors, of file `name`: another format, truncated.
Result<std::string_view> detect_format(std::span<const uint8_t> bytes, const std::string& name);

} // namespace blush
