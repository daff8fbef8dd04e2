// Internal to gltf_*.cpp: the pixels of a file's textures, decoded beside whatever else is done, and within a limit of memory.
#pragma once

#include "io/gltf_source.h"

#include <memory>
#include <span>

namespace blush {

class ImageDecoding {
public:
    // Looks at the headers of `wanted`, indices of images, where those of none are passed over, and begins to decode. Files with the same bytes
    // become one image. Where all would exceed ImportOptions::texture_bytes, the largest are halved until they do not, with a warning each. Grey
    // images become RGB. The context must outlive this. Errors: a buffer view that is none.
    static Result<ImageDecoding> begin(const GltfContext& context, std::span<const int> wanted);
    ImageDecoding(ImageDecoding&&) noexcept;
    ~ImageDecoding(); // what has not been begun by then is left

    // Its header promises pixels.
    bool is_expected(int image) const;
    bool is_done() const;
    // Waits for what is left, reporting progress from 0.6 to 1; what cannot be decoded is a warning. Errors: cancelled.
    Result<void> finish();
    // Once finished: all that were expected could be decoded.
    bool is_as_promised() const;
    // Once finished, those that could be decoded; else null.
    ImagePtr image(int index) const;

private:
    struct State;
    explicit ImageDecoding(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace blush
