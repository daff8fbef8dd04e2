// What the window knows of the images on materials: which of them a file is being chosen for, and their small pictures.
#pragma once

#include "scene/scene.h"

#include <memory>
#include <string>

namespace blush {

class MapThumbnails;

struct MapView {
    // What the next chosen image file is for.
    Id<Material> material;
    TextureRef Material::*slot = nullptr;
    std::string label;                             // of the slot
    std::shared_ptr<MapThumbnails> thumbnails = {}; // none: without a window
};

} // namespace blush
