// Base64, for images within HTML and SVG files (RFC 4648).
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace blush {

std::string base64(std::span<const uint8_t> bytes);

} // namespace blush
