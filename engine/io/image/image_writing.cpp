// Writing of images: EXR, PNG and JPEG. Files are encoded in memory, so that write_file handles disk errors for all formats.
#include "core/files.h"
#include "core/memory_limit.h"
#include "io/codec/guarded.h"
#include "io/codec/image_codec.h"
#include "io/image/image_io.h"
#include "io/image/jpeg_encoding.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace blush {
namespace {

Result<void> write_encoded(const std::filesystem::path& file, const Result<std::vector<uint8_t>>& encoded) {
    if (!encoded) return encoded.error();
    return write_file(file, *encoded);
}

Result<std::vector<uint8_t>> encoded_png(const std::string& name, const PngPixels& pixels,
                                         const std::map<std::string, std::string>& metadata = {}) {
    const Result<const ImageCodec*> codec = image_codec(name);
    return codec ? (*codec)->encode_png(name, pixels, metadata) : codec.error();
}

// The comparison is false for NaN, which becomes 0.
std::vector<uint8_t> display_bytes(std::span<const float> rgb) {
    std::vector<uint8_t> bytes(rgb.size());
    std::transform(rgb.begin(), rgb.end(), bytes.begin(),
                   [](float v) { return v > 0 ? uint8_t(std::min(v, 1.0f) * 255 + 0.5f) : uint8_t(0); });
    return bytes;
}

// Interleaves RGB and alpha to RGBA.
std::vector<uint8_t> with_alpha(const std::vector<uint8_t>& rgb, const std::vector<uint8_t>& alpha) {
    std::vector<uint8_t> rgba(4 * alpha.size());
    for (size_t i = 0; i < alpha.size(); ++i) {
        std::copy_n(&rgb[3 * i], 3, &rgba[4 * i]);
        rgba[4 * i + 3] = alpha[i];
    }
    return rgba;
}

bool is_rgb_of(std::span<const float> rgb, int width, int height) {
    return width >= 1 && height >= 1 && rgb.size() == size_t(width) * size_t(height) * 3;
}

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

bool is_jpeg_name(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    return extension == ".jpg" || extension == ".jpeg";
}

// JPEG gets no metadata: its segments hold 64 KB.
Result<void> write_jpeg(const std::filesystem::path& file, int width, int height, std::span<const float> rgb) {
    if (const Result<void> fits = expect_jpeg_size(file, width, height); !fits) return fits.error();
    return write_encoded(file, encode_jpeg(file.string(), width, height, display_bytes(rgb)));
}

} // namespace

Result<void> expect_jpeg_size(const std::filesystem::path& file, int width, int height) {
    if (std::max(width, height) > max_jpeg_side)
        return Error{file.string(), fmt::format("a JPEG has at most {} pixels a side, not {} x {}", max_jpeg_side, width, height), ""};
    // Worst-case memory of the encoder and the file.
    const double needed = 8e6 + 16.0 * width * height;
    if (const MemoryLimit room = memory_limit(); needed > double(room.left))
        return Error{file.string(),
                     fmt::format("a JPEG of {} x {} pixels needs {:.2g} GB of memory: {}", width, height, needed / 1e9, room.text()), ""};
    return {};
}

Result<void> load_encoder(const std::filesystem::path& file) {
    if (is_jpeg_name(file)) return {};
    const Result<const ImageCodec*> codec = image_codec(file.string());
    return codec ? Result<void>() : codec.error();
}

Result<void> write_exr(const std::filesystem::path& file, const LayeredImage& image) {
    const size_t pixels = size_t(std::max(image.width, 0)) * size_t(std::max(image.height, 0));
    if (pixels == 0 || image.channels.empty()) return Error{file.string(), "an image without pixels or channels cannot be written", ""};
    for (const LayeredImage::Channel& channel : image.channels) {
        const size_t size = channel.is_uint && !channel.words.empty() ? channel.words.size() : channel.values.size();
        if (size != pixels) return Error{file.string(), "channel of the wrong size", channel.name};
    }
    const Result<const ImageCodec*> codec = image_codec(file.string());
    if (!codec) return codec.error();
    return write_encoded(file, (*codec)->encode_exr(file.string(), image));
}

Result<void> write_display_image(const std::filesystem::path& file, int width, int height, std::span<const float> rgb,
                                 const std::map<std::string, std::string>& metadata, std::span<const float> alpha) {
    return guarded(file.string(), [&]() -> Result<void> {
        const bool is_jpeg = is_jpeg_name(file);
        if (!is_jpeg && extension_of(file) != ".png") return Error{file.string(), "not a .png or .jpg name", ""};
        if (!is_rgb_of(rgb, width, height))
            return Error{file.string(), "an image without pixels or of the wrong size cannot be written", ""};
        if (is_jpeg) return write_jpeg(file, width, height, rgb);
        if (!alpha.empty() && alpha.size() != rgb.size() / 3)
            return Error{file.string(), "an alpha of the wrong size cannot be written", ""};
        const std::vector<uint8_t> bytes = alpha.empty() ? display_bytes(rgb) : with_alpha(display_bytes(rgb), display_bytes(alpha));
        const PngPixels pixels{width, height, alpha.empty() ? 3 : 4, bytes, {}, /*is_display*/ true};
        return write_encoded(file, encoded_png(file.string(), pixels, metadata));
    });
}

Result<std::vector<uint8_t>> encode_png(int width, int height, std::span<const float> rgb) {
    return guarded("image.png", [&]() -> Result<std::vector<uint8_t>> {
        if (!is_rgb_of(rgb, width, height)) return Error{"", "an image without pixels or of the wrong size cannot be encoded", ""};
        const std::vector<uint8_t> bytes = display_bytes(rgb);
        return encoded_png("image.png", {width, height, 3, bytes, {}, /*is_display*/ true});
    });
}

Result<std::vector<uint8_t>> encode_png(const Image& image) {
    const size_t values = image.bytes.empty() ? image.floats.size() : image.bytes.size();
    if (values == 0 || values != size_t(image.width) * size_t(image.height) * size_t(image.channels))
        return Error{"", "an image without pixels or of the wrong size cannot be encoded", ""};
    return encoded_png("texture.png", {image.width, image.height, image.channels, image.bytes, image.floats});
}

} // namespace blush
