// Reads environment maps from image files.
#pragma once

#include "io/image/image_io.h"

namespace blush {

// Lat-long image in float with 3 or 4 channels, as Environment::image requires: 8-bit files are converted from sRGB to linear,
// grey is copied to R, G and B. Negative and non-finite values are kept: the renderer reads them as 0 and reports their number
// (render/lights/environment_table.h). While an image of a file is in use, reading the unchanged file returns that image. Errors as in
// read_image.
Result<ImagePtr> read_environment_image(const std::filesystem::path& file, const ImageLimits& limits = {});
// The same from memory; `name` is for messages.
Result<ImagePtr> read_environment_image(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits = {});

} // namespace blush
