#include "app/commands/base64.h"

namespace blush {

std::string base64(std::span<const uint8_t> bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t word = uint32_t(bytes[i]) << 16;
        if (i + 1 < bytes.size()) word |= uint32_t(bytes[i + 1]) << 8;
        if (i + 2 < bytes.size()) word |= bytes[i + 2];
        text += digits[word >> 18];
        text += digits[word >> 12 & 63];
        text += i + 1 < bytes.size() ? digits[word >> 6 & 63] : '=';
        text += i + 2 < bytes.size() ? digits[word & 63] : '=';
    }
    return text;
}

} // namespace blush
