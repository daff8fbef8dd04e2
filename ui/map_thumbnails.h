// Small pictures of the images on materials, as textures of the graphics card.
#pragma once

#include "scene/scene.h"
#include "ui/gl_objects.h"

#include <cstdint>
#include <imgui.h>
#include <map>
#include <vector>

namespace blush {

// A picture's longer side is this many pixels at most.
constexpr int map_preview_side = 256;

struct SmallImage {
    int width = 0, height = 0;
    std::vector<uint8_t> rgb;
};
// Means of an image's pixels as they are stored, without alpha; one channel is grey. Empty for an image without pixels.
SmallImage small_image(const Image& image);

// Made when they are first asked for. A graphics context must be current.
class MapThumbnails {
public:
    struct Picture {
        ImTextureID texture = nullptr;
        float width = 0, height = 0; // pixels
    };
    Picture of(const Image& image);

private:
    static constexpr size_t most = 256; // then all are made anew
    struct Kept {
        GlTexture texture;
        int width = 0, height = 0;
    };
    std::map<uint64_t, Kept> kept_; // by the image's serial number
};

} // namespace blush
