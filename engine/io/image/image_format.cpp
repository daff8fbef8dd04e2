#include "io/image/image_format.h"

#include <algorithm>

namespace blush {
namespace {

// Empty: unknown.
std::string_view format_of(std::span<const uint8_t> bytes) {
    const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<size_t>(bytes.size(), 16));
    if (head.starts_with("\x89PNG\r\n\x1a\n")) return "png";
    if (head.starts_with("\xff\xd8\xff")) return "jpeg";
    if (head.starts_with("\x76\x2f\x31\x01")) return "openexr";
    if (head.starts_with("#?RADIANCE") || head.starts_with("#?RGBE")) return "hdr";
    if (head.starts_with("RIFF") && head.size() >= 12 && head.substr(8, 4) == "WEBP") return "webp";
    if (head.starts_with("BM")) return "bmp";
    return {};
}

// True for KTX2, Khronos' container of GPU-compressed textures.
bool is_ktx2(std::span<const uint8_t> bytes) {
    constexpr std::string_view magic = "\xabKTX 20\xbb\r\n\x1a\n";
    return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).starts_with(magic);
}

} // namespace

Result<std::string_view> detect_format(std::span<const uint8_t> bytes, const std::string& name) {
    if (is_ktx2(bytes)) return Error{name, "KTX2 cannot be decoded", ""};
    const std::string_view format = format_of(bytes);
    if (format.empty()) return Error{name, "not an image in a known format (PNG, JPEG, EXR, HDR, WebP, BMP)", ""};
    if (format == "jpeg" && !is_complete_jpeg(bytes)) return Error{name, "truncated JPEG", ""};
    if (format == "png" && !is_complete_png(bytes)) return Error{name, "truncated PNG", ""};
    return format;
}

} // namespace blush
