#include "io/codec/guarded.h"
#include "io/codec/oiio.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <memory>
#include <mutex>

namespace blush {
namespace {

constexpr int max_channels = 2048;                       // a film with every plane, 16 light groups and 32 bounces has about 1300
constexpr uint64_t max_layers_bytes = uint64_t(4) << 30; // limit of all channels of a layered image: zeros compress to almost nothing

// Limit of the compression ratio: deflate reaches about 1000 for constant images. Small images are always decoded.
constexpr uint64_t max_compression = 4096, always_decoded = uint64_t(64) << 20; // bytes

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
    std::string_view format; // as from detect_format
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
Result<void> within_limits(const Decoder& decoder, const EncodedImage& file) {
    const OIIO::ImageSpec& spec = decoder.spec();
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 || spec.nchannels > max_channels || spec.deep)
        return Error{decoder.name, "not a flat image with at least one pixel",
                     fmt::format("{} x {}, {} channels", spec.width, spec.height, spec.nchannels)};
    if (spec.width > file.limits.max_side || spec.height > file.limits.max_side ||
        int64_t(spec.width) * spec.height > file.limits.max_pixels)
        return Error{decoder.name, "larger than the limit", fmt::format("{} x {} pixels", spec.width, spec.height)};
    const uint64_t decoded = uint64_t(spec.width) * uint64_t(spec.height) * uint64_t(spec.nchannels) * spec.format.size();
    if (decoded > always_decoded && decoded / max_compression > file.bytes.size())
        return Error{decoder.name, "more pixels than its bytes can hold",
                     fmt::format("{} x {} pixels in {} bytes", spec.width, spec.height, file.bytes.size())};
    return {};
}

Result<Decoder> open_decoder(const EncodedImage& file) {
    lower_library_limits();
    Decoder decoder;
    decoder.name = file.name;
    decoder.format = file.format;
    decoder.input = OIIO::ImageInput::create(std::string(file.format));
    if (!decoder.input || !decoder.input->supports("ioproxy"))
        return Error{file.name, fmt::format("no decoder for {} files", file.format), ""};
    decoder.bytes = std::make_unique<OIIO::Filesystem::IOMemReader>(file.bytes.data(), file.bytes.size());
    decoder.input->set_ioproxy(decoder.bytes.get());
    OIIO::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!decoder.input->open(file.name, spec, config)) return decoder.error();
    if (const Result<void> sound = within_limits(decoder, file); !sound) return sound.error();
    return decoder;
}

ImageInfo info_of(const Decoder& decoder) {
    const OIIO::ImageSpec& spec = decoder.spec();
    return {decoder.format, spec.width, spec.height, std::min(spec.nchannels, 4), spec.format != OIIO::TypeDesc::UINT8};
}

// Passes the rows of an image from the top, a few at a time.
template <class T> Result<void> read_rows(Decoder& decoder, int channels, OIIO::TypeDesc type, RowSink& sink) {
    const OIIO::ImageSpec& spec = decoder.spec();
    const int band = spec.tile_width > 0 ? spec.height : 16;
    std::vector<T> rows(size_t(spec.width) * size_t(std::min(band, spec.height)) * size_t(channels));
    for (int y = 0; y < spec.height; y += band) {
        const int end = std::min(y + band, spec.height);
        const bool ok = spec.tile_width > 0
                            ? decoder.input->read_image(0, 0, 0, channels, type, rows.data())
                            : decoder.input->read_scanlines(0, 0, spec.y + y, spec.y + end, 0, 0, channels, type, rows.data());
        if (!ok) return decoder.error();
        sink.add(std::span<const T>(rows).first(size_t(spec.width) * size_t(end - y) * size_t(channels)));
    }
    return {};
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

} // namespace

Result<DecodedPixels> OiioCodec::decode(const EncodedImage& file) const {
    return guarded(file.name, [&]() -> Result<DecodedPixels> {
        Result<Decoder> decoder = open_decoder(file);
        if (!decoder) return decoder.error();
        const OIIO::ImageSpec& spec = decoder->spec();
        DecodedPixels image{spec.width, spec.height, std::min(spec.nchannels, 4)};
        if (spec.format == OIIO::TypeDesc::UINT8) {
            Result<std::vector<uint8_t>> values = decoder->read<uint8_t>(0, image.channels, OIIO::TypeDesc::UINT8);
            if (!values) return values.error();
            image.bytes = *std::move(values);
        } else {
            Result<std::vector<float>> values = decoder->read<float>(0, image.channels, OIIO::TypeDesc::FLOAT);
            if (!values) return values.error();
            image.floats = *std::move(values);
        }
        return image;
    });
}

Result<ImageInfo> OiioCodec::decode_info(const EncodedImage& file) const {
    return guarded(file.name, [&]() -> Result<ImageInfo> {
        const Result<Decoder> decoder = open_decoder(file);
        if (!decoder) return decoder.error();
        return info_of(*decoder);
    });
}

Result<void> OiioCodec::decode_rows(const EncodedImage& file, RowSink& sink) const {
    return guarded(file.name, [&]() -> Result<void> {
        Result<Decoder> decoder = open_decoder(file);
        if (!decoder) return decoder.error();
        const ImageInfo info = info_of(*decoder);
        sink.begin(info);
        return info.is_float ? read_rows<float>(*decoder, info.channels, OIIO::TypeDesc::FLOAT, sink)
                             : read_rows<uint8_t>(*decoder, info.channels, OIIO::TypeDesc::UINT8, sink);
    });
}

Result<std::vector<LayeredImage>> OiioCodec::decode_parts(const EncodedImage& file, int max_parts) const {
    return guarded(file.name, [&]() -> Result<std::vector<LayeredImage>> {
        Result<Decoder> decoder = open_decoder(file);
        if (!decoder) return decoder.error();
        std::vector<LayeredImage> parts;
        uint64_t taken = 0;
        bool has_next = true;
        while (has_next && decoder->part < max_parts) {
            if (const Result<void> sound = within_limits(*decoder, file); !sound) return sound.error();
            Result<LayeredImage> part = decode_part(*decoder, taken);
            if (!part) return part.error();
            parts.push_back(*std::move(part));
            has_next = decoder->input->seek_subimage(++decoder->part, 0);
        }
        for (LayeredImage& part : parts) part.more_parts = has_next || parts.size() > 1;
        return parts;
    });
}

Result<std::map<std::string, std::string>> OiioCodec::decode_metadata(const EncodedImage& file) const {
    return guarded(file.name, [&]() -> Result<std::map<std::string, std::string>> {
        const Result<Decoder> decoder = open_decoder(file);
        if (!decoder) return decoder.error();
        return text_metadata(decoder->spec());
    });
}

} // namespace blush
