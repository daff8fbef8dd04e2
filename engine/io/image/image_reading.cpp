// Reading of images: files, formats; the codec decodes.
#include "core/box_filter.h"
#include "core/files.h"
#include "io/codec/guarded.h"
#include "io/codec/image_codec.h"
#include "io/image/image_format.h"
#include "io/image/image_io.h"
#include "io/image/image_shrinker.h"

#include <optional>

namespace blush {
namespace {

constexpr uint64_t max_file_bytes = uint64_t(4) << 30;

// decode(codec, EncodedImage) of the bytes, whose format is checked first.
template <class Decode>
auto with_codec(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits, const Decode& decode)
    -> decltype(decode(std::declval<const ImageCodec&>(), std::declval<const EncodedImage&>())) {
    const Result<std::string_view> format = detect_format(bytes, name);
    if (!format) return format.error();
    const Result<const ImageCodec*> codec = image_codec(name);
    if (!codec) return codec.error();
    return guarded(name, [&] { return decode(**codec, EncodedImage{bytes, *format, name, limits}); });
}
// The same of a file.
template <class Decode> auto with_codec(const std::filesystem::path& file, const ImageLimits& limits, const Decode& decode) {
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_file_bytes);
    using Decoded = decltype(with_codec(*bytes, file.string(), limits, decode));
    return bytes ? with_codec(*bytes, file.string(), limits, decode) : Decoded(bytes.error());
}

Result<ImagePtr> decoded(const ImageCodec& codec, const EncodedImage& file) {
    Result<DecodedPixels> pixels = codec.decode(file);
    if (!pixels) return pixels.error();
    auto image = std::make_shared<Image>();
    image->width = pixels->width;
    image->height = pixels->height;
    image->channels = pixels->channels;
    image->bytes = std::move(pixels->bytes);
    image->floats = std::move(pixels->floats);
    return ImagePtr(std::move(image));
}

// Shrinks the rows that it gets.
class ShrinkingSink final : public RowSink {
public:
    ShrinkingSink(int halvings, bool is_srgb) : halvings_(halvings), is_srgb_(is_srgb) {}

    void begin(const ImageInfo& info) override {
        shrinker_.emplace(ImageShrinker::Source{info.width, info.height, info.channels, info.is_float, is_srgb_}, halvings_);
    }
    void add(std::span<const uint8_t> rows) override { shrinker_->add(rows); }
    void add(std::span<const float> rows) override { shrinker_->add(rows); }
    // After all rows.
    ImagePtr image() && { return std::move(*shrinker_).image(); }

private:
    int halvings_;
    bool is_srgb_;
    std::optional<ImageShrinker> shrinker_ = {};
};

} // namespace

Result<ImagePtr> read_image(const std::filesystem::path& file, const ImageLimits& limits) { return with_codec(file, limits, decoded); }

Result<ImagePtr> read_image(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits) {
    return with_codec(bytes, name, limits, decoded);
}

int64_t ImageInfo::bytes(int halvings) const {
    return int64_t(halved(width, halvings)) * halved(height, halvings) * channels * int64_t(is_float ? sizeof(float) : 1);
}

Result<ImageInfo> read_image_info(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits) {
    return with_codec(bytes, name, limits, [](const ImageCodec& codec, const EncodedImage& encoded) { return codec.decode_info(encoded); });
}

Result<ImagePtr> read_smaller_image(std::span<const uint8_t> bytes, const std::string& name, int halvings, bool is_srgb,
                                    const ImageLimits& limits) {
    return with_codec(bytes, name, limits, [&](const ImageCodec& codec, const EncodedImage& encoded) -> Result<ImagePtr> {
        ShrinkingSink sink(halvings, is_srgb);
        if (const Result<void> read = codec.decode_rows(encoded, sink); !read) return read.error();
        return std::move(sink).image();
    });
}

Result<LayeredImage> read_layers(const std::filesystem::path& file, const ImageLimits& limits) {
    return with_codec(file, limits, [](const ImageCodec& codec, const EncodedImage& encoded) -> Result<LayeredImage> {
        Result<std::vector<LayeredImage>> parts = codec.decode_parts(encoded, 1);
        if (!parts) return parts.error();
        return std::move(parts->front());
    });
}

Result<std::vector<LayeredImage>> read_parts(const std::filesystem::path& file, const ImageLimits& limits) {
    constexpr int max_parts = 1024;
    return with_codec(file, limits,
                      [](const ImageCodec& codec, const EncodedImage& encoded) { return codec.decode_parts(encoded, max_parts); });
}

Result<std::map<std::string, std::string>> read_metadata(const std::filesystem::path& file, const ImageLimits& limits) {
    return with_codec(file, limits, [](const ImageCodec& codec, const EncodedImage& encoded) { return codec.decode_metadata(encoded); });
}

} // namespace blush
