// Writing of images: EXR, PNG and JPEG.
#include "core/files.h"
#include "core/memory_limit.h"
#include "io/image/image_io.h"
#include "io/image/jpeg_encoding.h"
#include "io/image/oiio.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/half.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fmt/format.h>
#include <memory>

namespace blush {
namespace {

// Encodes into memory, so that write_file handles disk errors for all formats. `name` is for messages.
Result<std::vector<uint8_t>> encode(const std::string& name, const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                                    const void* pixels) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output) return Error{name, fmt::format("no encoder for {} files", format), ""};
    if (!output->set_ioproxy(&sink) || !output->open(name, spec) || !output->write_image(type, pixels) || !output->close())
        return Error{name, "cannot encode: " + one_line(output->geterror()), ""};
    return bytes;
}

Result<void> encode_to_file(const std::filesystem::path& file, const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                            const void* pixels) {
    const Result<std::vector<uint8_t>> bytes = encode(file.string(), format, spec, type, pixels);
    if (!bytes) return bytes.error();
    return write_file(file, *bytes);
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

OIIO::TypeDesc stored_as(const LayeredImage::Channel& channel) {
    if (channel.is_uint) return OIIO::TypeDesc::UINT32;
    return channel.is_half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
}

// Interleaves the channels, each in its storage type.
std::vector<uint8_t> in_native_layout(const LayeredImage& image, const OIIO::ImageSpec& spec, size_t pixels) {
    const size_t stride = spec.pixel_bytes(true);
    std::vector<uint8_t> packed(pixels * stride);
    size_t offset = 0;
    for (const LayeredImage::Channel& channel : image.channels) {
        const auto pack = [&](const auto& value_of) {
            for (size_t i = 0; i < pixels; ++i) {
                const auto value = value_of(i);
                std::memcpy(&packed[i * stride + offset], &value, sizeof value);
            }
            offset += sizeof(value_of(0));
        };
        if (channel.is_uint && !channel.words.empty()) {
            pack([&](size_t i) { return channel.words[i]; });
        } else if (channel.is_uint) {
            pack([&](size_t i) { return channel.values[i] > 0 && channel.values[i] < 4294967296.0f ? uint32_t(channel.values[i]) : 0u; });
        } else if (channel.is_half) {
            pack([&](size_t i) { return half(std::clamp(channel.values[i], -max_half, max_half)); });
        } else {
            pack([&](size_t i) { return channel.values[i]; });
        }
    }
    return packed;
}

bool is_rgb_of(std::span<const float> rgb, int width, int height) {
    return width >= 1 && height >= 1 && rgb.size() == size_t(width) * size_t(height) * 3;
}

OIIO::ImageSpec png_spec(int width, int height) {
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("compression", "zip");
    return spec;
}

// Copies the header attributes of a file that was read, except its storage format.
void keep_header(OIIO::ImageSpec& spec, const OIIO::ImageSpec& read) {
    spec.x = read.x;
    spec.y = read.y;
    spec.full_x = read.full_x;
    spec.full_y = read.full_y;
    spec.full_width = read.full_width;
    spec.full_height = read.full_height;
    for (const OIIO::ParamValue& attribute : read.extra_attribs) {
        const std::string_view name = attribute.name().string();
        if (!name.starts_with("oiio:") && !name.starts_with("openexr:") && name != "compression") spec.extra_attribs.push_back(attribute);
    }
}

// Relative to the first pixel.
void set_display_window(OIIO::ImageSpec& spec, const PixelRect& window) {
    spec.full_x = spec.x + window.x0;
    spec.full_y = spec.y + window.y0;
    spec.full_width = window.x1 - window.x0;
    spec.full_height = window.y1 - window.y0;
}

void set_metadata(OIIO::ImageSpec& spec, const std::map<std::string, std::string>& metadata) {
    for (const auto& [key, value] : metadata) spec.attribute(key, value);
}

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

// JPEG gets no metadata: its segments hold 64 KB.
Result<void> write_jpeg(const std::filesystem::path& file, int width, int height, std::span<const float> rgb) {
    if (const Result<void> fits = expect_jpeg_size(file, width, height); !fits) return fits.error();
    const Result<std::vector<uint8_t>> encoded = encode_jpeg(file.string(), width, height, display_bytes(rgb));
    if (!encoded) return encoded.error();
    return write_file(file, *encoded);
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

Result<void> write_exr(const std::filesystem::path& file, const LayeredImage& image) {
    return guarded(file.string(), [&]() -> Result<void> {
        const size_t pixels = size_t(std::max(image.width, 0)) * size_t(std::max(image.height, 0));
        if (pixels == 0 || image.channels.empty()) return Error{file.string(), "an image without pixels or channels cannot be written", ""};
        OIIO::ImageSpec spec(image.width, image.height, int(image.channels.size()), OIIO::TypeDesc::FLOAT);
        spec.channelnames.clear();
        for (const LayeredImage::Channel& channel : image.channels) {
            const size_t size = channel.is_uint && !channel.words.empty() ? channel.words.size() : channel.values.size();
            if (size != pixels) return Error{file.string(), "channel of the wrong size", channel.name};
            spec.channelnames.push_back(channel.name);
            spec.channelformats.push_back(stored_as(channel));
        }
        if (image.header) keep_header(spec, image.header->spec);
        if (image.display_window) set_display_window(spec, *image.display_window);
        set_metadata(spec, image.metadata);
        spec.attribute("compression", "zip");
        const std::vector<uint8_t> packed = in_native_layout(image, spec, pixels);
        return encode_to_file(file, "openexr", spec, OIIO::TypeDesc::UNKNOWN, packed.data());
    });
}

Result<void> write_display_image(const std::filesystem::path& file, int width, int height, std::span<const float> rgb,
                                 const std::map<std::string, std::string>& metadata, std::span<const float> alpha) {
    return guarded(file.string(), [&]() -> Result<void> {
        const std::string extension = extension_of(file);
        const bool is_jpeg = extension == ".jpg" || extension == ".jpeg";
        if (!is_jpeg && extension != ".png") return Error{file.string(), "not a .png or .jpg name", ""};
        if (!is_rgb_of(rgb, width, height))
            return Error{file.string(), "an image without pixels or of the wrong size cannot be written", ""};
        if (is_jpeg) return write_jpeg(file, width, height, rgb);
        std::vector<uint8_t> bytes = display_bytes(rgb);
        OIIO::ImageSpec spec = png_spec(width, height);
        if (!alpha.empty()) {
            if (alpha.size() != rgb.size() / 3) return Error{file.string(), "an alpha of the wrong size cannot be written", ""};
            bytes = with_alpha(bytes, display_bytes(alpha));
            spec.nchannels = 4;
            spec.default_channel_names();
            spec.attribute("oiio:UnassociatedAlpha", 1);
        }
        set_metadata(spec, metadata);
        return encode_to_file(file, "png", spec, OIIO::TypeDesc::UINT8, bytes.data());
    });
}

Result<std::vector<uint8_t>> encode_png(int width, int height, std::span<const float> rgb) {
    return guarded("image.png", [&]() -> Result<std::vector<uint8_t>> {
        if (!is_rgb_of(rgb, width, height)) return Error{"", "an image without pixels or of the wrong size cannot be encoded", ""};
        const std::vector<uint8_t> bytes = display_bytes(rgb);
        return encode("image.png", "png", png_spec(width, height), OIIO::TypeDesc::UINT8, bytes.data());
    });
}

Result<std::vector<uint8_t>> encode_png(const Image& image) {
    return guarded("texture.png", [&]() -> Result<std::vector<uint8_t>> {
        const bool bytes = !image.bytes.empty();
        const size_t values = bytes ? image.bytes.size() : image.floats.size();
        if (values == 0 || values != size_t(image.width) * size_t(image.height) * size_t(image.channels))
            return Error{"", "an image without pixels or of the wrong size cannot be encoded", ""};
        OIIO::ImageSpec spec(image.width, image.height, image.channels, bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16);
        spec.attribute("oiio:UnassociatedAlpha", 1);
        if (bytes) return encode("texture.png", "png", spec, OIIO::TypeDesc::UINT8, image.bytes.data());
        return encode("texture.png", "png", spec, OIIO::TypeDesc::FLOAT, image.floats.data());
    });
}

} // namespace blush
