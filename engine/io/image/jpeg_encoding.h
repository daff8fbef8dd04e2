// Encoding of JPEG.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace blush {

// Display-encoded RGB bytes, without chroma subsampling: saturated edges keep their colour. `name` is for messages.
Result<std::vector<uint8_t>> encode_jpeg(const std::string& name, int width, int height, std::span<const uint8_t> rgb);

} // namespace blush
