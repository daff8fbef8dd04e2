// Loads image files for the metrics.
#pragma once

#include "measure/metrics/metrics.h"

#include <filesystem>
#include <string>

namespace blush {

struct ImageToCompare {
    RgbImage image;
    Encoding encoding = Encoding::scene_linear;
};

// R, G and B of an EXR or of one of its layers ("denoised"), or any other image; grey is converted to three equal channels. EXR,
// HDR and other float formats are scene-linear; PNG, JPEG, WebP and BMP are display-encoded.
// Errors name the file.
Result<ImageToCompare> read_image_to_compare(const std::filesystem::path& file, const std::string& layer = {});

} // namespace blush
