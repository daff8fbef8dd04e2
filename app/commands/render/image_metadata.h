// The metadata of a rendered image: `blush render` and the parts of `blush plan`.
#pragma once

#include "app/commands/load_scene.h"
#include "app/commands/render/render_loop.h"
#include "io/image/snapshot.h"

#include <string>

namespace blush {

// All but `denoised` and `film`. `hash`: scene_hash() of the imported scene.
SnapshotMetadata image_metadata(const std::filesystem::path& scene_file, const std::string& hash, const LoadedScene& loaded,
                                const RenderSettings& settings, const LoopResult& result);

} // namespace blush
