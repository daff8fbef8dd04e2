// Reads (image_reading.cpp) and writes (image_writing.cpp) images. Treats any input as hostile. The first call of a process loads
// OpenImageIO (io/codec/image_codec.h), if it is not a JPEG that is written.
#pragma once

#include "core/result.h"
#include "scene/image_region.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

struct ImageLimits {
    int max_side = 65536;
    int64_t max_pixels = int64_t(1) << 28; // checked with the header, before decoding
};

// Reads PNG, JPEG, EXR, HDR, WebP and BMP, detected by their first bytes. 8-bit files stay bytes, others become float; channels
// beyond 4 are dropped. Colour spaces are not converted, alpha is not premultiplied. Errors: unreadable, unknown format, beyond
// the limits, truncated, more pixels than the file size allows.
Result<ImagePtr> read_image(const std::filesystem::path& file, const ImageLimits& limits = {});
// The same from memory; `name` is for messages.
Result<ImagePtr> read_image(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits = {});

// Header data of an image.
struct ImageInfo {
    std::string_view format; // "png", "jpeg", ... detected from the bytes
    int width = 0, height = 0, channels = 0;
    bool is_float = false; // more than 8 bits per channel

    // Size of the decoded Image after its sides are halved this many times.
    int64_t bytes(int halvings = 0) const;
};
// Reads the header only. Errors as in read_image.
Result<ImageInfo> read_image_info(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits = {});
// The image with its sides halved `halvings` times, box filtered (in linear light if `is_srgb`). Needs only a few rows of memory
// besides the result, if the format can be read by rows.
Result<ImagePtr> read_smaller_image(std::span<const uint8_t> bytes, const std::string& name, int halvings, bool is_srgb,
                                    const ImageLimits& limits = {});

// Header attributes of a file besides pixels and text: windows, numbers, matrices.
struct ImageHeader;

// Longest side of a JPEG that can be written, in pixels: the encoder's limit.
constexpr int max_jpeg_side = 65500;

// Named channels of equal size, as in an EXR: "R", "albedo.R", "id.object", ... and string metadata ("blush:spp").
struct LayeredImage {
    struct Channel {
        std::string name;
        std::vector<float> values;        // width * height, top row first
        bool is_uint = false;             // stored as 32-bit unsigned (ids): values hold exact integers below 2^24
        std::vector<uint32_t> words = {}; // exact values of a uint channel: set when read, written instead of `values`
        bool is_half = false;             // written as 16-bit float; larger values are clamped to its maximum
    };
    int width = 0, height = 0;
    std::vector<Channel> channels;
    std::map<std::string, std::string> metadata;
    std::shared_ptr<const ImageHeader> header = {}; // of an EXR that was read; write_exr writes it back
    bool more_parts = false;                        // the file has other parts, which were not read
    std::string part = {};                          // name of the part in a multi-part file
    std::optional<PixelRect> display_window = {};   // of an EXR, relative to the data window; empty: equal to it

    const Channel* find(std::string_view name) const;
    // R, G and B of a layer ("denoised"; "" is the beauty), or its Y three times; three nullptr if missing.
    std::array<const Channel*, 3> find_color(std::string_view layer = {}) const;
    // Replaces the channel of that name, or inserts it after the channel `behind` (at the end if there is none).
    void set(Channel channel, std::string_view behind = {});
};

// Reads every channel of the file as float, and its text metadata. Errors as in read_image.
Result<LayeredImage> read_layers(const std::filesystem::path& file, const ImageLimits& limits = {});
// Reads every part of a multi-part file. Errors as above; the size limits apply to the sum of all parts.
Result<std::vector<LayeredImage>> read_parts(const std::filesystem::path& file, const ImageLimits& limits = {});
// Reads the text metadata only.
Result<std::map<std::string, std::string>> read_metadata(const std::filesystem::path& file, const ImageLimits& limits = {});
// Loads what writing `file` needs: call it before a long render, so that a missing library is reported before it, not after it.
Result<void> load_encoder(const std::filesystem::path& file);
constexpr float max_half = 65504;
// Writes an EXR: float32 unless a channel is uint or half, ZIP compression. Atomic: written to a temporary name beside the target
// and renamed.
Result<void> write_exr(const std::filesystem::path& file, const LayeredImage& image);
// Checks whether a JPEG of that size can be written; call it first, since libjpeg ends the process otherwise. Errors: sides above
// max_jpeg_side, not enough memory.
Result<void> expect_jpeg_size(const std::filesystem::path& file, int width, int height);
// Writes display-encoded RGB in [0, 1], width * height * 3; .png or .jpg by extension; text metadata is written to .png only.
// Atomic. `alpha`: width * height, straight (not premultiplied); empty: opaque. JPEG ignores it.
Result<void> write_display_image(const std::filesystem::path& file, int width, int height, std::span<const float> rgb,
                                 const std::map<std::string, std::string>& metadata = {}, std::span<const float> alpha = {});

// Encodes a .png in memory, for embedding in other documents.
Result<std::vector<uint8_t>> encode_png(int width, int height, std::span<const float> rgb);
// Encodes an image without colour conversion: bytes are lossless, floats in [0, 1] are rounded to 16 bits.
Result<std::vector<uint8_t>> encode_png(const Image& image);

} // namespace blush
