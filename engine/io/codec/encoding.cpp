#include "io/codec/guarded.h"
#include "io/codec/oiio.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/half.h>

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <memory>

namespace blush {
namespace {

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

} // namespace

Result<std::vector<uint8_t>> OiioCodec::encode_exr(const std::string& name, const LayeredImage& image) const {
    return guarded(name, [&]() -> Result<std::vector<uint8_t>> {
        OIIO::ImageSpec spec(image.width, image.height, int(image.channels.size()), OIIO::TypeDesc::FLOAT);
        spec.channelnames.clear();
        for (const LayeredImage::Channel& channel : image.channels) {
            spec.channelnames.push_back(channel.name);
            spec.channelformats.push_back(stored_as(channel));
        }
        if (image.header) keep_header(spec, image.header->spec);
        if (image.display_window) set_display_window(spec, *image.display_window);
        set_metadata(spec, image.metadata);
        spec.attribute("compression", "zip");
        const std::vector<uint8_t> packed = in_native_layout(image, spec, size_t(image.width) * size_t(image.height));
        return encode(name, "openexr", spec, OIIO::TypeDesc::UNKNOWN, packed.data());
    });
}

Result<std::vector<uint8_t>> OiioCodec::encode_png(const std::string& name, const PngPixels& pixels,
                                                   const std::map<std::string, std::string>& metadata) const {
    return guarded(name, [&]() -> Result<std::vector<uint8_t>> {
        const bool is_float = pixels.bytes.empty();
        OIIO::ImageSpec spec(pixels.width, pixels.height, pixels.channels, is_float ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
        spec.attribute("oiio:UnassociatedAlpha", 1);
        if (pixels.is_display) {
            spec.attribute("oiio:ColorSpace", "sRGB");
            spec.attribute("compression", "zip");
        }
        set_metadata(spec, metadata);
        return is_float ? encode(name, "png", spec, OIIO::TypeDesc::FLOAT, pixels.floats.data())
                        : encode(name, "png", spec, OIIO::TypeDesc::UINT8, pixels.bytes.data());
    });
}

} // namespace blush
