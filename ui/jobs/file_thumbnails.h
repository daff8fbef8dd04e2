// Thumbnails of files. Scenes: shipped ones for the demos, else those saved when the scene was last shown. Images: made from
// their pixels in the background.
#pragma once

#include "color/color_management.h"
#include "core/result.h"
#include "render/frame.h"
#include "scene/scene.h"
#include "scene/view_settings.h"
#include "ui/gl/gl_objects.h"
#include "ui/jobs/background_job.h"

#include <imgui.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace blush {

// assets/thumbnails/NAME.png for a scene in assets/scenes; else a file in the user's cache, named by a hash of the scene's path.
// Empty if the user has no cache folder.
std::filesystem::path thumbnail_file(const std::filesystem::path& scene, const std::filesystem::path& assets);

// Saves the displayed image as a PNG of Thumbnail's size. Errors: colour transform fails, folder not writable.
Result<void> write_thumbnail(const std::filesystem::path& file, const Frame& frame, const ViewSettings& view, const ColorManagement& color);

// The image at Thumbnail's size, letterboxed with black: display RGB, width * height * 3. 8-bit images are shown unchanged.
// Floats are exposed so that their log-average luminance is middle grey, 0.18 (Reinhard et al. 2002, equation 1); black and
// non-finite pixels are ignored.
std::vector<float> image_thumbnail(const Image& image);

// A file in the user's cache for the thumbnail of an image, named by a hash of its path, size and modification time. Empty if the
// user has no cache folder.
std::filesystem::path image_thumbnail_file(const std::filesystem::path& image);

// Textures of thumbnails, loaded on first use. A graphics context must be current.
class FileThumbnails {
public:
    // `wake` is called when a thumbnail becomes available that was requested before.
    FileThumbnails(std::filesystem::path assets, std::function<void()> wake) : assets_(std::move(assets)), wake_(std::move(wake)) {}
    // 0 if there is none (yet). Thumbnails of images are made one at a time.
    ImTextureID of(const std::string& file);
    void forget(const std::string& file) { textures_.erase(file); }

private:
    GlTexture kept(const std::filesystem::path& thumbnail) const;
    ImTextureID image(const std::string& file);

    std::filesystem::path assets_;
    std::function<void()> wake_;
    std::map<std::string, GlTexture> textures_; // key without a texture: there is no thumbnail
    std::string making_;
    std::unique_ptr<BackgroundJob<bool>> job_; // result true: the file is in the cache
};

} // namespace blush
