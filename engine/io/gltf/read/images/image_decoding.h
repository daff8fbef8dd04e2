// Internal to io/gltf: decodes the images of a file in the background, within a memory limit.
#pragma once

#include "io/gltf/read/context.h"

#include <memory>
#include <span>

namespace blush {

class ImageDecoding {
public:
    // Reads the headers of the images `wanted` (negative indices are skipped) and starts decoding. Images with identical bytes
    // are decoded once. If the total would exceed ImportOptions::texture_bytes, the largest are halved until it fits, with a
    // warning each. Grey images become RGB. The context must outlive this object. Errors: a buffer view that does not exist.
    static Result<ImageDecoding> begin(const GltfContext& context, std::span<const int> wanted);
    ImageDecoding(ImageDecoding&&) noexcept;
    ~ImageDecoding(); // drops images whose decoding has not started

    // True if the header is valid, so that decoding will probably succeed.
    bool is_expected(int image) const;
    bool is_done() const;
    // Waits for the remaining images and reports progress from 0.6 to 1. An image that cannot be decoded is a warning. Errors:
    // cancelled.
    Result<void> finish();
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
