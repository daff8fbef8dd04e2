#include "ui/scene_thumbnails.h"

#include "core/files.h"
#include "io/displayed.h"
#include "io/image_io.h"
#include "ui/snapshots_view.h"
#include "ui/texture_id.h"

#include <fmt/format.h>

namespace blush {
namespace {

// FNV-1a, 64 bits: the same name in every version of the program.
uint64_t hash_of(const std::string& text) {
    uint64_t hash = 0xcbf29ce484222325;
    for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001b3;
    return hash;
}

GlTexture uploaded(const Image& image) {
    GlTexture texture = GlTexture::create();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, image.width, image.height, 0, image.channels == 4 ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE, image.bytes.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

} // namespace

std::filesystem::path thumbnail_file(const std::filesystem::path& scene, const std::filesystem::path& assets) {
    std::error_code error;
    if (std::filesystem::equivalent(scene.parent_path(), assets / "scenes", error)) return assets / "thumbnails" / (scene.stem().string() + ".png");
    const std::filesystem::path cache = user_folder("XDG_CACHE_HOME", ".cache");
    return cache.empty() ? cache : cache / "blush" / "thumbnails" / fmt::format("{:016x}.png", hash_of(scene.string()));
}

Result<void> write_thumbnail(const std::filesystem::path& file, const Frame& frame, const ViewSettings& view, const ColorManagement& color) {
    const Thumbnail small = thumbnail_of(frame);
    std::vector<float> rgb(size_t(Thumbnail::width) * Thumbnail::height * 3);
    for (size_t i = 0; i < rgb.size(); ++i) rgb[i] = small.rgba[i / 3 * 4 + i % 3];
    ViewSettings shown = view;
    shown.false_color = {};
    if (const auto done = show(color, shown, rgb); !done) return done.error();
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    return write_display_image(file, Thumbnail::width, Thumbnail::height, rgb);
}

ImTextureID SceneThumbnails::of(const std::string& scene) {
    const auto known = textures_.find(scene);
    if (known != textures_.end()) return texture_id(known->second.name());
    constexpr int most_pixels_across = 1024; // a file in the cache may be anything
    const Result<ImagePtr> image = read_image(thumbnail_file(scene, assets_));
    const bool fits = image && (**image).width <= most_pixels_across && (**image).height <= most_pixels_across && !(**image).bytes.empty() && (**image).channels >= 3;
    return texture_id((textures_[scene] = fits ? uploaded(**image) : GlTexture()).name());
}

} // namespace blush
