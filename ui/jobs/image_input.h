// Input of jobs that measure an image: the scene and the settings it is rendered with.
#pragma once

#include "scene/render_settings.h"
#include "scene/scene.h"

namespace blush {

struct ImageInput {
    Scene scene;
    RenderSettings settings;
    // True if both give the same image.
    bool has_same_result(const ImageInput& other) const;
};

} // namespace blush
