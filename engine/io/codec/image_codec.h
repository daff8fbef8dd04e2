// Decodes and encodes image files: OpenImageIO behind an interface. Its 240 shared libraries take 0.2 s and 80 MB to load, so they
// belong to a module, which the first image that is read or written loads. A process without images does without.
#pragma once

#include "io/image/image_io.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// Gets the rows of an image.
class RowSink {
public:
    // Before the rows.
    virtual void begin(const ImageInfo& info) = 0;
    // Further complete rows from the top, in the type that `info` has, tightly packed.
    virtual void add(std::span<const uint8_t> rows) = 0;
    virtual void add(std::span<const float> rows) = 0;

protected:
    ~RowSink() = default;
};

// As in Image, which only the program makes: it numbers them.
struct DecodedPixels {
    int width = 0, height = 0, channels = 0;
    std::vector<uint8_t> bytes = {};
    std::vector<float> floats = {};
};

// Pixels for a PNG, tightly packed: either bytes, which are stored as they are, or floats in [0, 1], which become 16 bits.
struct PngPixels {
    int width = 0, height = 0, channels = 0; // 1..4; the last of 2 or 4 is straight alpha
    std::span<const uint8_t> bytes = {};
    std::span<const float> floats = {};
    bool is_display = false; // the file says that its colours are sRGB
};

// The content of an image file.
struct EncodedImage {
    std::span<const uint8_t> bytes;
    std::string_view format; // as from detect_format
    const std::string& name; // for messages
    const ImageLimits& limits;
};

// Errors: as in image_io.h. Thread-safe.
class ImageCodec {
public:
    virtual Result<DecodedPixels> decode(const EncodedImage& file) const = 0;
    // The header alone.
    virtual Result<ImageInfo> decode_info(const EncodedImage& file) const = 0;
    virtual Result<void> decode_rows(const EncodedImage& file, RowSink& sink) const = 0;
    // At most `max_parts` parts, from the first. All have `more_parts` set if the file has more than one.
    virtual Result<std::vector<LayeredImage>> decode_parts(const EncodedImage& file, int max_parts) const = 0;
    virtual Result<std::map<std::string, std::string>> decode_metadata(const EncodedImage& file) const = 0;
    // `name` is for messages.
    virtual Result<std::vector<uint8_t>> encode_exr(const std::string& name, const LayeredImage& image) const = 0;
    virtual Result<std::vector<uint8_t>> encode_png(const std::string& name, const PngPixels& pixels,
                                                    const std::map<std::string, std::string>& metadata) const = 0;

protected:
    ~ImageCodec() = default;
};

// Loads the module, unless a call before did, and keeps it until the process ends. Error, of file `name`: the module, or a library that
// it needs, is missing; memory is short; the module is of another version of Blush. Thread-safe.
Result<const ImageCodec*> image_codec(const std::string& name);
// Seconds that loading took; empty before it.
std::optional<double> image_codec_load_seconds();

} // namespace blush
