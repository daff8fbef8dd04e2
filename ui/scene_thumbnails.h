// Small pictures of scene files: shipped ones for the demos, else those that the window kept when it last showed the scene.
#pragma once

#include "color/color_management.h"
#include "core/result.h"
#include "render/frame.h"
#include "scene/view_settings.h"
#include "ui/gl_objects.h"

#include <imgui.h>

#include <filesystem>
#include <map>
#include <string>

namespace blush {

// assets/thumbnails/NAME.png for a scene in assets/scenes; else a file in the user's cache, named after a hash of the scene's path. Empty
// if the user has no cache.
std::filesystem::path thumbnail_file(const std::filesystem::path& scene, const std::filesystem::path& assets);

// The picture as it is shown, as a PNG of Thumbnail's size. Errors: a colour transform that fails, a folder that cannot be written.
Result<void> write_thumbnail(const std::filesystem::path& file, const Frame& frame, const ViewSettings& view, const ColorManagement& color);

// Textures of thumbnail files, read when they are first asked for. A graphics context must be current.
class SceneThumbnails {
public:
    explicit SceneThumbnails(std::filesystem::path assets) : assets_(std::move(assets)) {}
    // 0 where there is none.
    ImTextureID of(const std::string& scene);
    void forget(const std::string& scene) { textures_.erase(scene); }

private:
    std::filesystem::path assets_;
    std::map<std::string, GlTexture> textures_; // without a name: there is no picture
};

} // namespace blush
