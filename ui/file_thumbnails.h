// Small pictures of files: of scenes the shipped ones for the demos, else those that the window kept when it last showed the scene; of images
// their pixels, made in the background.
#pragma once

#include "color/color_management.h"
#include "core/result.h"
#include "render/frame.h"
#include "scene/scene.h"
#include "scene/view_settings.h"
#include "ui/background_job.h"
#include "ui/gl_objects.h"

#include <imgui.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace blush {

// assets/thumbnails/NAME.png for a scene in assets/scenes; else a file in the user's cache, named after a hash of the scene's path. Empty
// if the user has no cache.
std::filesystem::path thumbnail_file(const std::filesystem::path& scene, const std::filesystem::path& assets);

// The picture as it is shown, as a PNG of Thumbnail's size. Errors: a colour transform that fails, a folder that cannot be written.
Result<void> write_thumbnail(const std::filesystem::path& file, const Frame& frame, const ViewSettings& view, const ColorManagement& color);

// An image at Thumbnail's size, as large as it fits, the rest black: display RGB, width * height * 3. 8-bit images are shown as they are; floats are
// exposed so that their log-average luminance is middle grey, 0.18 (Reinhard et al. 2002, equation 1), pixels that are black or not finite apart.
std::vector<float> image_thumbnail(const Image& image);

// A file in the user's cache for the thumbnail of an image, named after its path, size and time of writing. Empty if the user has no cache.
std::filesystem::path image_thumbnail_file(const std::filesystem::path& image);

// Textures of thumbnails, read when they are first asked for. A graphics context must be current.
class FileThumbnails {
public:
    // `wake` is called when a thumbnail is there that was not when it was asked for.
    FileThumbnails(std::filesystem::path assets, std::function<void()> wake) : assets_(std::move(assets)), wake_(std::move(wake)) {}
    // 0 where there is none, or none yet. Of images one at a time is made.
    ImTextureID of(const std::string& file);
    void forget(const std::string& file) { textures_.erase(file); }

private:
    GlTexture kept(const std::filesystem::path& thumbnail) const;
    ImTextureID image(const std::string& file);

    std::filesystem::path assets_;
    std::function<void()> wake_;
    std::map<std::string, GlTexture> textures_; // without a name: there is no picture
    std::string making_;
    std::unique_ptr<BackgroundJob<bool>> job_; // true: the file is in the cache
};

} // namespace blush
