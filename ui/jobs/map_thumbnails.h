// Thumbnails of the textures of materials, on the GPU.
#pragma once

#include "scene/scene.h"
#include "ui/gl/gl_objects.h"

#include <cstdint>
#include <imgui.h>
#include <map>
#include <vector>

namespace blush {

// Maximum length of the longer side, in pixels.
constexpr int map_preview_side = 256;

struct SmallImage {
    int width = 0, height = 0;
    std::vector<uint8_t> rgb;
};
// Averages an image's stored pixel values, without alpha; one channel is shown as grey. Empty for an image without pixels.
SmallImage small_image(const Image& image);

// Created on first use. A graphics context must be current.
class MapThumbnails {
public:
    struct MapPreview {
        ImTextureID texture = nullptr;
        float width = 0, height = 0; // pixels
    };
    MapPreview of(const Image& image);

private:
    static constexpr size_t most = 256; // above this, all are dropped and created again
    struct Kept {
        GlTexture texture;
        int width = 0, height = 0;
    };
    std::map<uint64_t, Kept> kept_; // key: the image's serial number
};

} // namespace blush
