// UI state of material textures: the slot that a file is being chosen for, and the thumbnails.
#pragma once

#include "scene/scene.h"

#include <memory>
#include <string>

namespace blush {

class MapThumbnails;

struct MapView {
    // The slot for the next chosen image file.
    Id<Material> material;
    TextureRef Material::*slot = nullptr;
    std::string label;                              // of the slot
    std::shared_ptr<MapThumbnails> thumbnails = {}; // null without a window
};

} // namespace blush
