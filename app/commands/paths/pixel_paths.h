// The replayed samples of a pixel, as `blush paths` writes them.
#pragma once

#include "render/diagnostics/path_recorder.h"
#include "scene/render_settings.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace blush {

struct PixelPaths {
    std::string scene_file;
    Scene scene;
    RenderSettings settings; // with the range of samples
    int x = 0, y = 0;        // pixel, from the upper left corner
    std::vector<RecordedPath> paths = {};
    PathSum sum = {};
    Vec3d film{0, 0, 0};                    // the pixel of a render of the same samples, without what is not replayed
    std::vector<std::string> left_out = {}; // PathRecorder::not_replayed()
    std::optional<Vec3d> image = {};        // with it; empty if nothing is left out
};

// Of the sum from the film, as a fraction of the largest component; 0 if both are black.
double relative_difference(const PixelPaths& p);

} // namespace blush
