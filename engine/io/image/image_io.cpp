#include "io/image/image_io.h"

#include "core/box_filter.h"
#include "core/files.h"
#include "core/memory_limit.h"
#include "io/image/image_shrinker.h"
#include "io/image/image_truncation.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/half.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <mutex>
#include <new>

namespace blush {

struct ImageHeader {
    OIIO::ImageSpec spec;
};

namespace {

constexpr uint64_t max_file_bytes = uint64_t(4) << 30;
constexpr int max_channels = 256;
constexpr uint64_t max_layers_bytes = uint64_t(4) << 30; // limit of all channels of a layered image: zeros compress to almost nothing

// Limit of the compression ratio: deflate reaches about 1000 for constant images. Small images are always decoded.
constexpr uint64_t max_compression = 4096, always_decoded = uint64_t(64) << 20; // bytes

// The only decoders that are used: reduces the attack surface, and special names such as "x.null" have no effect. TIFF is
// excluded since its decoder fills truncated files with black and reports success.
const char* format_of(std::span<const uint8_t> bytes) {
    const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<size_t>(bytes.size(), 16));
    if (head.starts_with("\x89PNG\r\n\x1a\n")) return "png";
    if (head.starts_with("\xff\xd8\xff")) return "jpeg";
    if (head.starts_with("\x76\x2f\x31\x01")) return "openexr";
    if (head.starts_with("#?RADIANCE") || head.starts_with("#?RGBE")) return "hdr";
    if (head.starts_with("RIFF") && head.size() >= 12 && head.substr(8, 4) == "WEBP") return "webp";
    if (head.starts_with("BM")) return "bmp";
    return nullptr;
}

// True for KTX2, Khronos' container of GPU-compressed textures.
bool is_ktx2(std::span<const uint8_t> bytes) {
    constexpr std::string_view magic = "\xabKTX 20\xbb\r\n\x1a\n";
    return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).starts_with(magic);
}

// A second limit besides our header checks, for allocations of a decoder before it returns the header.
void lower_library_limits() {
    static std::once_flag once;
    std::call_once(once, [] {
        OIIO::attribute("limits:channels", max_channels);
        OIIO::attribute("limits:imagesize_MB", 16384);
    });
}

// OpenImageIO's messages have several lines; keeps the first.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text.empty() ? "unknown reason" : text;
}

// Converts exceptions of OpenImageIO and the allocator to an Error.
template <class F> auto guarded(const std::string& name, F&& work) -> decltype(work()) {
    try {
        return work();
    } catch (const std::bad_alloc&) { return Error{name, "not enough memory for the image", ""}; } catch (const std::exception& e) {
        return Error{name, one_line(e.what()), ""};
    }
}

struct Decoder {
    std::unique_ptr<OIIO::Filesystem::IOMemReader> bytes; // must outlive the input
    std::unique_ptr<OIIO::ImageInput> input;
    std::string name;
    std::string_view format; // as from format_of
    int part = 0;            // index in a multi-part file

    const OIIO::ImageSpec& spec() const { return input->spec(); }
    Error error() const { return {name, "cannot decode: " + one_line(input->geterror()), ""}; }

    // Channels [begin, end) of every pixel in `type`, tightly packed.
    template <class T> Result<std::vector<T>> read(int begin, int end, OIIO::TypeDesc type) {
        std::vector<T> values(size_t(spec().width) * size_t(spec().height) * size_t(end - begin));
        if (!input->read_image(part, 0, begin, end, type, values.data())) return error();
        return values;
    }
};

// Checks the current part of the decoder.
Result<void> within_limits(const Decoder& decoder, size_t bytes, const ImageLimits& limits) {
    const OIIO::ImageSpec& spec = decoder.spec();
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 || spec.nchannels > max_channels || spec.deep)
        return Error{decoder.name, "not a flat image with at least one pixel",
                     fmt::format("{} x {}, {} channels", spec.width, spec.height, spec.nchannels)};
    if (spec.width > limits.max_side || spec.height > limits.max_side || int64_t(spec.width) * spec.height > limits.max_pixels)
        return Error{decoder.name, "larger than the limit", fmt::format("{} x {} pixels", spec.width, spec.height)};
    const uint64_t decoded = uint64_t(spec.width) * uint64_t(spec.height) * uint64_t(spec.nchannels) * spec.format.size();
    if (decoded > always_decoded && decoded / max_compression > bytes)
        return Error{decoder.name, "more pixels than its bytes can hold",
                     fmt::format("{} x {} pixels in {} bytes", spec.width, spec.height, bytes)};
    return {};
}

Result<Decoder> open_decoder(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits) {
    lower_library_limits();
    const char* format = format_of(bytes);
    if (is_ktx2(bytes)) return Error{name, "KTX2 cannot be decoded", ""};
    if (!format) return Error{name, "not an image in a known format (PNG, JPEG, EXR, HDR, WebP, BMP)", ""};
    if (std::string_view(format) == "jpeg" && !is_complete_jpeg(bytes)) return Error{name, "truncated JPEG", ""};
    if (std::string_view(format) == "png" && !is_complete_png(bytes)) return Error{name, "truncated PNG", ""};
    Decoder decoder;
    decoder.name = name;
    decoder.format = format;
    decoder.input = OIIO::ImageInput::create(format);
    if (!decoder.input || !decoder.input->supports("ioproxy")) return Error{name, fmt::format("no decoder for {} files", format), ""};
    decoder.bytes = std::make_unique<OIIO::Filesystem::IOMemReader>(bytes.data(), bytes.size());
    decoder.input->set_ioproxy(decoder.bytes.get());
    OIIO::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!decoder.input->open(name, spec, config)) return decoder.error();
    if (const Result<void> sound = within_limits(decoder, bytes.size(), limits); !sound) return sound.error();
    return decoder;
}

Result<ImagePtr> decode(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits) {
    Result<Decoder> decoder = open_decoder(bytes, name, limits);
    if (!decoder) return decoder.error();
    auto image = std::make_shared<Image>();
    image->width = decoder->spec().width;
    image->height = decoder->spec().height;
    image->channels = std::min(decoder->spec().nchannels, 4);
    if (decoder->spec().format == OIIO::TypeDesc::UINT8) {
        Result<std::vector<uint8_t>> values = decoder->read<uint8_t>(0, image->channels, OIIO::TypeDesc::UINT8);
        if (!values) return values.error();
        image->bytes = *std::move(values);
    } else {
        Result<std::vector<float>> values = decoder->read<float>(0, image->channels, OIIO::TypeDesc::FLOAT);
        if (!values) return values.error();
        image->floats = *std::move(values);
    }
    return ImagePtr(std::move(image));
}

ImageInfo info_of(const Decoder& decoder) {
    const OIIO::ImageSpec& spec = decoder.spec();
    return {decoder.format, spec.width, spec.height, std::min(spec.nchannels, 4), spec.format != OIIO::TypeDesc::UINT8};
}

// Passes the rows of an image from the top, a few at a time.
template <class T> Result<void> read_rows(Decoder& decoder, int channels, OIIO::TypeDesc type, ImageShrinker& shrinker) {
    const OIIO::ImageSpec& spec = decoder.spec();
    const int band = spec.tile_width > 0 ? spec.height : 16;
    std::vector<T> rows(size_t(spec.width) * size_t(std::min(band, spec.height)) * size_t(channels));
    for (int y = 0; y < spec.height; y += band) {
        const int end = std::min(y + band, spec.height);
        const bool ok = spec.tile_width > 0
                            ? decoder.input->read_image(0, 0, 0, channels, type, rows.data())
                            : decoder.input->read_scanlines(0, 0, spec.y + y, spec.y + end, 0, 0, channels, type, rows.data());
        if (!ok) return decoder.error();
        shrinker.add(std::span<const T>(rows).first(size_t(spec.width) * size_t(end - y) * size_t(channels)));
    }
    return {};
}

Result<ImagePtr> decode_smaller(std::span<const uint8_t> bytes, const std::string& name, int halvings, bool is_srgb,
                                const ImageLimits& limits) {
    Result<Decoder> decoder = open_decoder(bytes, name, limits);
    if (!decoder) return decoder.error();
    const ImageInfo info = info_of(*decoder);
    ImageShrinker shrinker({info.width, info.height, info.channels, info.is_float, is_srgb}, halvings);
    const Result<void> read = info.is_float ? read_rows<float>(*decoder, info.channels, OIIO::TypeDesc::FLOAT, shrinker)
                                            : read_rows<uint8_t>(*decoder, info.channels, OIIO::TypeDesc::UINT8, shrinker);
    if (!read) return read.error();
    return std::move(shrinker).image();
}

std::map<std::string, std::string> text_metadata(const OIIO::ImageSpec& spec) {
    std::map<std::string, std::string> texts;
    for (const OIIO::ParamValue& attribute : spec.extra_attribs)
        if (attribute.type() == OIIO::TypeDesc::STRING) texts[attribute.name().string()] = attribute.get_string();
    return texts;
}

std::optional<PixelRect> display_window_of(const OIIO::ImageSpec& spec) {
    const PixelRect all{0, 0, spec.width, spec.height};
    const int x = spec.full_x - spec.x, y = spec.full_y - spec.y;
    const PixelRect window{x, y, x + spec.full_width, y + spec.full_height};
    return window == all ? std::nullopt : std::optional(window);
}

bool is_uint_channel(const OIIO::ImageSpec& spec, int channel) { return spec.channelformat(channel) == OIIO::TypeDesc::UINT32; }

// Adjacent channels of the same type are decoded together. 32-bit integers are not read as float, since that would scale them to
// [0, 1].
// `taken`: bytes of parts that were decoded before.
Result<LayeredImage> decode_part(Decoder& decoder, uint64_t& taken) {
    const OIIO::ImageSpec spec = decoder.spec();
    const size_t pixels = size_t(spec.width) * size_t(spec.height);
    taken += pixels * uint64_t(spec.nchannels) * sizeof(float);
    if (taken > max_layers_bytes)
        return Error{decoder.name, "larger than the limit",
                     fmt::format("{} x {} pixels, {} channels", spec.width, spec.height, spec.nchannels)};
    LayeredImage image{spec.width, spec.height, {}, text_metadata(spec)};
    image.part = spec.get_string_attribute("oiio:subimagename");
    image.display_window = display_window_of(spec);
    if (decoder.format == "openexr") image.header = std::make_shared<ImageHeader>(spec);
    for (int begin = 0, end = 0; begin < spec.nchannels; begin = end) {
        const bool is_uint = is_uint_channel(spec, begin);
        while (end < spec.nchannels && is_uint_channel(spec, end) == is_uint) ++end;
        // Both types have four bytes: they share a buffer, reinterpreted per value.
        Result<std::vector<uint32_t>> values = decoder.read<uint32_t>(begin, end, is_uint ? OIIO::TypeDesc::UINT32 : OIIO::TypeDesc::FLOAT);
        if (!values) return values.error();
        const size_t stride = size_t(end - begin);
        for (int c = begin; c < end; ++c) {
            LayeredImage::Channel channel{spec.channel_name(c), std::vector<float>(pixels), is_uint};
            if (is_uint) channel.words.resize(pixels);
            for (size_t i = 0; i < pixels; ++i) {
                const uint32_t bits = (*values)[i * stride + size_t(c - begin)];
                channel.values[i] = is_uint ? float(bits) : std::bit_cast<float>(bits);
                if (is_uint) channel.words[i] = bits;
            }
            image.channels.push_back(std::move(channel));
        }
    }
    return image;
}

Result<LayeredImage> decode_layers(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits) {
    Result<Decoder> decoder = open_decoder(bytes, name, limits);
    if (!decoder) return decoder.error();
    uint64_t taken = 0;
    Result<LayeredImage> image = decode_part(*decoder, taken);
    if (image) image->more_parts = decoder->input->seek_subimage(1, 0);
    return image;
}

Result<std::vector<LayeredImage>> decode_parts(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits) {
    constexpr int most_parts = 1024;
    Result<Decoder> decoder = open_decoder(bytes, name, limits);
    if (!decoder) return decoder.error();
    std::vector<LayeredImage> parts;
    uint64_t taken = 0;
    do {
        if (const Result<void> sound = within_limits(*decoder, bytes.size(), limits); !sound) return sound.error();
        Result<LayeredImage> part = decode_part(*decoder, taken);
        if (!part) return part.error();
        parts.push_back(*std::move(part));
        ++decoder->part;
    } while (decoder->part < most_parts && decoder->input->seek_subimage(decoder->part, 0));
    for (LayeredImage& part : parts) part.more_parts = parts.size() > 1;
    return parts;
}

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

OIIO::ImageSpec display_spec(int width, int height, const char* compression) {
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("compression", compression);
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

const char* display_format(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    if (extension == ".png") return "png";
    return extension == ".jpg" || extension == ".jpeg" ? "jpeg" : nullptr;
}

} // namespace

Result<ImagePtr> read_image(const std::filesystem::path& file, const ImageLimits& limits) {
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_file_bytes);
    if (!bytes) return bytes.error();
    return read_image(*bytes, file.string(), limits);
}

Result<ImagePtr> read_image(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits) {
    return guarded(name, [&] { return decode(bytes, name, limits); });
}

int64_t ImageInfo::bytes(int halvings) const {
    return int64_t(halved(width, halvings)) * halved(height, halvings) * channels * int64_t(is_float ? sizeof(float) : 1);
}

Result<ImageInfo> read_image_info(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits) {
    return guarded(name, [&]() -> Result<ImageInfo> {
        const Result<Decoder> decoder = open_decoder(bytes, name, limits);
        if (!decoder) return decoder.error();
        return info_of(*decoder);
    });
}

Result<ImagePtr> read_smaller_image(std::span<const uint8_t> bytes, const std::string& name, int halvings, bool is_srgb,
                                    const ImageLimits& limits) {
    return guarded(name, [&] { return decode_smaller(bytes, name, halvings, is_srgb, limits); });
}

Result<LayeredImage> read_layers(const std::filesystem::path& file, const ImageLimits& limits) {
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_file_bytes);
    if (!bytes) return bytes.error();
    return guarded(file.string(), [&] { return decode_layers(*bytes, file.string(), limits); });
}

Result<std::vector<LayeredImage>> read_parts(const std::filesystem::path& file, const ImageLimits& limits) {
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_file_bytes);
    if (!bytes) return bytes.error();
    return guarded(file.string(), [&] { return decode_parts(*bytes, file.string(), limits); });
}

Result<std::map<std::string, std::string>> read_metadata(const std::filesystem::path& file, const ImageLimits& limits) {
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_file_bytes);
    if (!bytes) return bytes.error();
    return guarded(file.string(), [&]() -> Result<std::map<std::string, std::string>> {
        const Result<Decoder> decoder = open_decoder(*bytes, file.string(), limits);
        if (!decoder) return decoder.error();
        return text_metadata(decoder->spec());
    });
}

Result<void> expect_jpeg_size(const std::filesystem::path& file, int width, int height) {
    if (std::max(width, height) > max_jpeg_side)
        return Error{file.string(), fmt::format("a JPEG has at most {} pixels a side, not {} x {}", max_jpeg_side, width, height), ""};
    // Worst-case memory of the encoder and the file: libjpeg ends the process if allocation fails.
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
        const char* format = display_format(file);
        if (!format) return Error{file.string(), "not a .png or .jpg name", ""};
        if (!is_rgb_of(rgb, width, height))
            return Error{file.string(), "an image without pixels or of the wrong size cannot be written", ""};
        const bool is_jpeg = format == std::string_view("jpeg");
        if (is_jpeg)
            if (const Result<void> fits = expect_jpeg_size(file, width, height); !fits) return fits.error();
        std::vector<uint8_t> bytes = display_bytes(rgb);
        OIIO::ImageSpec spec = display_spec(width, height, is_jpeg ? "jpeg:95" : "zip");
        if (!is_jpeg && !alpha.empty()) {
            if (alpha.size() != rgb.size() / 3) return Error{file.string(), "an alpha of the wrong size cannot be written", ""};
            bytes = with_alpha(bytes, display_bytes(alpha));
            spec.nchannels = 4;
            spec.default_channel_names();
            spec.attribute("oiio:UnassociatedAlpha", 1);
        }
        spec.attribute("jpeg:subsampling", "4:4:4"); // saturated edges keep their colour
        if (!is_jpeg) set_metadata(spec, metadata);  // JPEG segments hold 64 KB; its encoder ends the process above that
        return encode_to_file(file, format, spec, OIIO::TypeDesc::UINT8, bytes.data());
    });
}

Result<std::vector<uint8_t>> encode_png(int width, int height, std::span<const float> rgb) {
    return guarded("picture.png", [&]() -> Result<std::vector<uint8_t>> {
        if (!is_rgb_of(rgb, width, height)) return Error{"", "an image without pixels or of the wrong size cannot be encoded", ""};
        const std::vector<uint8_t> bytes = display_bytes(rgb);
        return encode("picture.png", "png", display_spec(width, height, "zip"), OIIO::TypeDesc::UINT8, bytes.data());
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
