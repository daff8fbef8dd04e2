// Reading of images: formats, limits, decoding.
#include "core/box_filter.h"
#include "core/files.h"
#include "io/image/image_io.h"
#include "io/image/image_shrinker.h"
#include "io/image/image_truncation.h"
#include "io/image/oiio.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <memory>
#include <mutex>

namespace blush {
namespace {

constexpr uint64_t max_file_bytes = uint64_t(4) << 30;
constexpr int max_channels = 2048;                       // a film with every plane, 16 light groups and 32 bounces has about 1300
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
    constexpr int max_parts = 1024;
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
    } while (decoder->part < max_parts && decoder->input->seek_subimage(decoder->part, 0));
    for (LayeredImage& part : parts) part.more_parts = parts.size() > 1;
    return parts;
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

} // namespace blush
