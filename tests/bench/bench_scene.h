// The benchmark scenes.
#pragma once

#include "core/result.h"
#include "scene/render_settings.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace blush::bench {

struct BenchScene {
    std::filesystem::path file;
    Scene scene;
    bool ours = true; // in assets/scenes, not external
    std::string name() const { return file.filename().string(); }
};

// All glTF scenes of assets/scenes, by name.
Result<std::vector<BenchScene>> shipped_scenes();
// Those files of the peer comparison that exist in `folder`.
Result<std::vector<BenchScene>> peer_scenes(const std::filesystem::path& folder);

// Generated scenes in which the renderer does more beside tracing than in a Cornell box: a mesh of 263,000 triangles with textures
// under an environment image, 60,000 leaves cut out by masks, the same leaves blended, and a thousand copies of 100,000 triangles.
// Names begin with "generated-".
std::vector<BenchScene> generated_scenes();

// Settings of all rate comparisons: 512 x 512, box filter, no bounce limit.
RenderSettings rate_settings();
// Settings of the window: 1280 x 720, unlimited samples.
RenderSettings window_settings();

} // namespace blush::bench
