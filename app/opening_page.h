// The opening page's demos and thumbnails, and the thumbnails that the window keeps of scenes.
#pragma once

#include "render/frame.h"
#include "ui/panels/context.h"
#include "ui/file_thumbnails.h"

#include <filesystem>

namespace blush {

class OpeningPage {
public:
    OpeningPage(std::filesystem::path assets, std::function<void()> wake) : assets_(std::move(assets)), thumbnails_(assets_, std::move(wake)) {}
    // The shipped scenes, by name.
    std::vector<std::string> demos() const;
    // Of a scene or image file; 0: it has none, or none yet.
    ImTextureID thumbnail(const std::string& file) { return thumbnails_.of(file); }
    // Writes a thumbnail of the scene once its picture is good enough, and, with `leaving`, as it was last seen. Failing is silent: it is a cache.
    void keep_thumbnail(const std::filesystem::path& scene, const FramePtr& frame, const ViewSettings& view, const ColorManagement& color, bool leaving = false);

private:
    std::filesystem::path assets_, kept_; // kept_: the scene that has its thumbnail
    FileThumbnails thumbnails_;
};

} // namespace blush
