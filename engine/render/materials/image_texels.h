// The texels of one image as the kernel reads them.
#pragma once

#include "scene/scene.h"
#include "shading/texture.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace blush {

// Leaves new elements unset, for arrays that are filled afterwards.
template <class T> struct UnsetAllocator : std::allocator<T> {
    template <class U> struct rebind { using other = UnsetAllocator<U>; };
    template <class U, class... Args> void construct(U* p, Args&&... args) {
        if constexpr (sizeof...(Args) > 0) std::construct_at(p, std::forward<Args>(args)...);
    }
};
template <class T> using UnsetVector = std::vector<T, UnsetAllocator<T>>;

// Immutable: shared by the tables that read it. The image itself is read where it lies, if its pixels can be used as they are.
struct ImageTexels {
    ImagePtr image;
    bool is_color = false;            // sRGB-encoded
    std::vector<TextureLevel> levels; // the image and its mip levels; they point into the image or into the arrays below
    UnsetVector<uint8_t> bytes;       // of the image, converted
    UnsetVector<float> floats;
    UnsetVector<uint16_t> mip_halves;
    UnsetVector<float> mip_floats;
    int64_t replaced = 0; // invalid values

    // Without the image.
    size_t memory_bytes() const {
        return bytes.capacity() + mip_halves.capacity() * sizeof(uint16_t) + (floats.capacity() + mip_floats.capacity()) * sizeof(float);
    }
};
using ImageTexelsPtr = std::shared_ptr<const ImageTexels>;

// True if the image holds width x height pixels of 1 to 4 channels, and not more than max_texels.
bool is_whole(const Image& image);
// Grey images become RGB, missing alpha is 1. Float images used as colour count as sRGB-encoded if they stay within [0, 1], as in
// 16-bit PNG; a value above 1 marks linear data. Negative or non-finite values become 0. Mip levels are averaged in linear colour,
// and stored in half precision for 8-bit images. The image must be whole.
ImageTexelsPtr image_texels(ImagePtr image, bool is_color);
// The memory_bytes() of such texels, if the image can be used as it is.
int64_t texel_bytes(const Image& image);
// Linear values of the 256 bytes as sRGB.
const float* srgb_byte_values();

} // namespace blush
