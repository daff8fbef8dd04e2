// Demos and thumbnails of the start page, and the saved thumbnails of scenes.
#pragma once

#include "render/frame.h"
#include "ui/jobs/file_thumbnails.h"
#include "ui/panel_context.h"

#include <filesystem>

namespace blush {

class StartPage {
public:
    StartPage(std::filesystem::path assets, std::function<void()> wake)
        : assets_(std::move(assets)), thumbnails_(assets_, std::move(wake)) {}
    // The shipped scenes: the default scene and other plain ones first, the rest sorted by name.
    std::vector<std::string> demos() const;
    // Thumbnail of a scene or image file; 0: none (yet).
    ImTextureID thumbnail(const std::string& file) { return thumbnails_.of(file); }
    // Saves a thumbnail of the scene when its image is good enough, and, with `leaving`, of the last image. Failures are
    // ignored: it is a cache.
    void save_thumbnail(const std::filesystem::path& scene, const FramePtr& frame, const ViewSettings& view, const ColorManagement& color,
                        bool leaving = false);

private:
    std::filesystem::path assets_, kept_; // kept_: the scene whose thumbnail is saved
    FileThumbnails thumbnails_;
};

} // namespace blush
