// Environment maps from any image file.
#pragma once

#include "io/image_io.h"

namespace blush {

// Lat-long image in float with 3 or 4 channels, as Environment::image wants it: 8-bit files are taken to be sRGB and made
// linear, grey is spread over R, G and B. Values that are negative or not finite stay: the renderer reads them as 0 and says how many
// there are (render/environment_table.h). Errors as in read_image.
Result<ImagePtr> read_environment_image(const std::filesystem::path& file, const ImageLimits& limits = {});
// The same from memory; `name` is for messages.
Result<ImagePtr> read_environment_image(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits = {});

} // namespace blush
