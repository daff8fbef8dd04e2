#include "app/commands/compare_images.h"

#include "app/commands/common.h"
#include "io/image_io.h"

#include <algorithm>
#include <string>

namespace blush {
namespace {

std::string lower_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

Result<RgbImage> read_exr_rgb(const std::filesystem::path& file) {
    const Result<LayeredImage> image = read_layers(file);
    if (!image) return image.error();
    const LayeredImage::Channel* grey = image->find("Y");
    const LayeredImage::Channel *r = image->find("R"), *g = image->find("G"), *b = image->find("B");
    if (!(r && g && b)) r = g = b = grey;
    if (!r) return Error{.what = "the file has no channels R, G and B"};
    RgbImage rgb{image->width, image->height, {}};
    rgb.pixels.reserve(r->values.size());
    for (size_t i = 0; i < r->values.size(); ++i) rgb.pixels.push_back({r->values[i], g->values[i], b->values[i]});
    return rgb;
}

Result<RgbImage> read_plain_rgb(const std::filesystem::path& file) {
    const Result<ImagePtr> read = read_image(file);
    if (!read) return read.error();
    const Image& image = **read;
    const auto value = [&](size_t i) { return image.bytes.empty() ? image.floats[i] : float(image.bytes[i]) / 255; };
    const size_t channels = size_t(image.channels), green = channels >= 3 ? 1 : 0, blue = channels >= 3 ? 2 : 0;
    RgbImage rgb{image.width, image.height, {}};
    const size_t pixels = size_t(image.width) * size_t(image.height);
    rgb.pixels.reserve(pixels);
    for (size_t i = 0; i < pixels; ++i)
        rgb.pixels.push_back({value(i * channels), value(i * channels + green), value(i * channels + blue)});
    return rgb;
}

} // namespace

Result<ImageToCompare> read_image_to_compare(const std::filesystem::path& file) {
    const std::string extension = lower_extension(file);
    Result<RgbImage> rgb = extension == ".exr" ? read_exr_rgb(file) : read_plain_rgb(file);
    if (!rgb) return in_file(rgb.error(), file.string());
    constexpr std::string_view display_formats[] = {".png", ".jpg", ".jpeg", ".webp", ".bmp"};
    const bool display = std::ranges::find(display_formats, extension) != std::end(display_formats);
    return ImageToCompare{*std::move(rgb), display ? Encoding::display : Encoding::scene_linear};
}

} // namespace blush
