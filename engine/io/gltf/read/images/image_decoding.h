// Internal to io/gltf: decodes the images of a file in the background, within memory limits.
#pragma once

#include "io/gltf/read/context.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace blush {

// Decoded bytes of the images that may be decoded at the same time: an eighth of the memory that the process may still take, from
// 64 MiB to 1 GiB. Decoders need up to twice as much.
int64_t concurrent_decode_bytes(uint64_t memory_left);

class ImageDecoding {
public:
    // Reads the headers of the images `wanted` (negative indices are skipped) and starts decoding. Images with identical bytes
    // are decoded once. If the total would exceed ImportOptions::texture_bytes, the largest are halved until it fits, with a
    // warning each. Grey images become RGB. Images being decoded at the same time have at most concurrent_decode_bytes() bytes together, or
    // the largest one more. Images of colour come before others, and small ones before large ones. With
    // ImportOptions::on_preview_scene, large JPEGs are first decoded at an eighth of their size. The context must outlive this object.
    // Errors: a buffer view that does not exist.
    static Result<ImageDecoding> begin(const GltfContext& context, std::span<const int> wanted);
    ImageDecoding(ImageDecoding&&) noexcept;
    ~ImageDecoding(); // drops images whose decoding has not started

    // True if the header is valid, so that decoding will probably succeed.
    bool is_expected(int image) const;
    bool is_done() const;
    // Waits for the remaining images and reports progress from 0.6 to 1. Calls on_more() on this thread when the images of
    // available() have become more, with pauses, and when all of colour are there. An image that cannot be decoded is a warning. Errors:
    // cancelled.
    Result<void> finish(const std::function<void()>& on_more = {});
    // The image as far as it is known: decoded, at an eighth of its size, or null.
    ImagePtr available(int index) const;
    // After finish(): true if all expected images could be decoded.
    bool all_decoded() const;
    // After finish(): the image; null if it could not be decoded.
    ImagePtr image(int index) const;

private:
    struct State;
    explicit ImageDecoding(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace blush
