// The picture on the screen as a file.
#pragma once

#include "color/color_management.h"
#include "core/result.h"
#include "render/showcase.h"
#include "scene/edit.h"
#include "ui/denoise_view.h"

#include <filesystem>

namespace blush {

// Everything a snapshot is made of; copies are cheap, so it may be written while the user goes on.
struct SnapshotJob {
    Pictures pictures;
    DenoiseView view; // how they are looked at
    Project project;
    RenderSettings settings; // that the frame was rendered with
    Scene imported;          // the scene as its file has it
    std::filesystem::path scene_file;
    std::filesystem::path folder;
};

// The layered EXR of cli.md: the raw beauty always, the denoised picture as a layer beside it. Returns the file, named after the scene and
// numbered so that none is overwritten.
Result<std::filesystem::path> write_snapshot_exr(const SnapshotJob& job);
// The picture as it is looked at, through the display's view, as a PNG.
Result<std::filesystem::path> write_snapshot_png(const SnapshotJob& job, const ColorManagement& color);

} // namespace blush
