// Reading and writing images: the only file that knows OpenImageIO. Any input may be hostile.
#pragma once

#include "core/result.h"
#include "scene/picture_region.h"
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
    int64_t max_pixels = int64_t(1) << 28; // checked against the header before anything is decoded
};

// PNG, JPEG, EXR, HDR, WebP and BMP, told apart by their first bytes. 8-bit files stay bytes, everything else becomes
// float; at most 4 channels (more are cut). Values are not converted between colour spaces, alpha is not multiplied in.
// Errors: unreadable, unknown format, beyond the limits, truncated, more pixels than a file of its size can hold.
Result<ImagePtr> read_image(const std::filesystem::path& file, const ImageLimits& limits = {});
// The same from memory; `name` is for messages.
Result<ImagePtr> read_image(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits = {});

// What the header says.
struct ImageInfo {
    std::string_view format; // "png", "jpeg", ... whatever the file is called
    int width = 0, height = 0, channels = 0;
    bool is_float = false; // of more than 8 bits

    // Of the Image that becomes of it, with sides halved that often.
    int64_t bytes(int halvings = 0) const;
};
// Decodes no pixel. Errors as in read_image.
Result<ImageInfo> read_image_info(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits = {});
// The image with its sides halved that often; pixels become the mean of those that they replace, of their light where the colour is
// sRGB-encoded. Memory beside the result: a few rows, if the format can be read by rows.
Result<ImagePtr> read_smaller_image(std::span<const uint8_t> bytes, const std::string& name, int halvings, bool is_srgb,
                                    const ImageLimits& limits = {});

// What a file says of itself besides pixels and text: its windows, numbers, matrices.
struct ImageHeader;

// Longest side of a JPEG that can be written, in pixels: the encoder's limit.
constexpr int max_jpeg_side = 65500;

// Named channels of one size, as in an EXR: "R", "albedo.R", "id.object", ... and string metadata ("blush:spp").
struct LayeredImage {
    struct Channel {
        std::string name;
        std::vector<float> values; // width * height, top row first
        bool is_uint = false;      // stored as 32-bit unsigned (ids): values hold exact integers below 2^24
        std::vector<uint32_t> words = {}; // of such a channel, exactly: read as well, and written in place of values if there are any
        bool is_half = false;             // written as 16-bit float; what is beyond its range becomes its largest number
    };
    int width = 0, height = 0;
    std::vector<Channel> channels;
    std::map<std::string, std::string> metadata;
    std::shared_ptr<const ImageHeader> header = {}; // of an EXR that was read; write_exr keeps it
    bool more_parts = false;                        // the file holds other images, which were not read
    std::string part = {};                          // the name of the image in a file of several
    std::optional<PixelRect> display_window = {};   // of an EXR: what of it, or around it, is the picture; empty: all of it

    const Channel* find(std::string_view name) const;
    // The three channels of a layer ("denoised"; "" is the beauty), or its Y three times; nullptr thrice if there are none.
    std::array<const Channel*, 3> find_color(std::string_view layer = {}) const;
    // Replaces the channel of that name, or adds it behind `behind` (behind all, if there is none of that name).
    void set(Channel channel, std::string_view behind = {});
};

// Every channel of the file under its own name, as float, and its text metadata. Errors as in read_image.
Result<LayeredImage> read_layers(const std::filesystem::path& file, const ImageLimits& limits = {});
// Every image of a file of several parts. Errors as above; all parts together may not be larger than one may.
Result<std::vector<LayeredImage>> read_parts(const std::filesystem::path& file, const ImageLimits& limits = {});
// Its text metadata alone: nothing is decoded.
Result<std::map<std::string, std::string>> read_metadata(const std::filesystem::path& file, const ImageLimits& limits = {});
constexpr float largest_half = 65504;
// Written to a temporary name beside the target and renamed: the file is whole or not there. EXR: float32 but for what is said to be uint or
// half, ZIP.
Result<void> write_exr(const std::filesystem::path& file, const LayeredImage& image);
// Can a JPEG of that size be written? libjpeg ends the process over one that cannot, so this is asked before. Errors: sides above max_jpeg_side,
// not enough memory.
Result<void> expect_jpeg_size(const std::filesystem::path& file, int width, int height);
// Display-encoded RGB in [0, 1], width * height * 3; .png or .jpg by extension; text metadata survive in .png only. Atomic too.
// `alpha`: width * height, of colours that are not multiplied by it (straight), as PNG has it; empty: opaque. A JPEG has none.
Result<void> write_display_image(const std::filesystem::path& file, int width, int height, std::span<const float> rgb,
                                 const std::map<std::string, std::string>& metadata = {}, std::span<const float> alpha = {});

// The same as the bytes of a .png, for documents that carry their pictures with them.
Result<std::vector<uint8_t>> encode_png(int width, int height, std::span<const float> rgb);
// An image as it is, whatever its channels mean: bytes come back the same, floats within [0, 1] are rounded to 16 bits.
Result<std::vector<uint8_t>> encode_png(const Image& image);

} // namespace blush
