#include "app/commands/compare_images.h"

#include "app/commands/common.h"
#include "app/commands/render/write_image.h"
#include "io/image/image_io.h"

#include <fmt/format.h>

#include <string>

namespace blush {
namespace {

Result<RgbImage> read_exr_rgb(const std::filesystem::path& file, const std::string& layer) {
    const Result<LayeredImage> image = read_layers(file);
    if (!image) return image.error();
    const auto [r, g, b] = image->find_color(layer);
    if (!r)
        return Error{.what =
                         layer.empty() ? "the file has no channels R, G and B" : fmt::format("the file has no layer {}.{{R,G,B}}", layer)};
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

Result<ImageToCompare> read_image_to_compare(const std::filesystem::path& file, const std::string& layer) {
    const bool is_exr = lower_extension(file) == ".exr";
    if (!layer.empty() && !is_exr) return Error{file.string(), "only an EXR has layers", ""};
    Result<RgbImage> rgb = is_exr ? read_exr_rgb(file, layer) : read_plain_rgb(file);
    if (!rgb) return in_file(rgb.error(), file.string());
    return ImageToCompare{*std::move(rgb), is_display_encoded(file) ? Encoding::display : Encoding::scene_linear};
}

} // namespace blush
