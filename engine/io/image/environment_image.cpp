#include "io/image/environment_image.h"

#include "core/srgb.h"
#include "io/image/image_channels.h"

namespace blush {
namespace {

std::vector<float> linear_floats(const Image& image) {
    if (image.bytes.empty()) return image.floats;
    std::vector<float> floats(image.bytes.size());
    for (size_t i = 0; i < floats.size(); ++i) {
        const bool alpha = image.channels == 4 && i % 4 == 3;
        const float v = float(image.bytes[i]) / 255;
        floats[i] = alpha ? v : linear_from_srgb(v);
    }
    return floats;
}

Result<ImagePtr> as_environment(const Result<ImagePtr>& read) {
    if (!read) return read.error();
    const ImagePtr colored = with_color_channels(*read);
    if (!colored->floats.empty()) return colored;
    auto image = std::make_shared<Image>();
    image->width = colored->width;
    image->height = colored->height;
    image->channels = colored->channels;
    image->floats = linear_floats(*colored);
    return ImagePtr(std::move(image));
}

} // namespace

Result<ImagePtr> read_environment_image(const std::filesystem::path& file, const ImageLimits& limits) {
    return as_environment(read_image(file, limits));
}

Result<ImagePtr> read_environment_image(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits) {
    return as_environment(read_image(bytes, name, limits));
}

} // namespace blush
