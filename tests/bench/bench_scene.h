// The scenes that are measured.
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
    bool ours = true; // in assets/scenes, not from outside
    std::string name() const { return file.filename().string(); }
};

// All glTF scenes of assets/scenes, by name.
Result<std::vector<BenchScene>> shipped_scenes();
// Of the files the peers are measured on, those that are in `folder`.
Result<std::vector<BenchScene>> peer_scenes(const std::filesystem::path& folder);

// Settings of every comparison of rates: 512 x 512, box filter, no limit of bounces.
RenderSettings rate_settings();
// As the window renders: 1280 x 720, without end.
RenderSettings window_settings();

} // namespace blush::bench
