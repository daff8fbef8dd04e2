#include "ui/jobs/file_thumbnails.h"

#include "core/files.h"
#include "core/math.h"
#include "core/srgb.h"
#include "io/image/display_image.h"
#include "io/image/image_io.h"
#include "ui/gl/texture_id.h"
#include "ui/snapshots/snapshots_view.h"
#include "ui/window/file_listing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

// FNV-1a, 64 bits: stable file names across versions.
uint64_t hash_of(const std::string& text) {
    uint64_t hash = 0xcbf29ce484222325;
    for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001b3;
    return hash;
}

GlTexture uploaded(const Image& image) {
    GlTexture texture = GlTexture::create();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, image.width, image.height, 0, image.channels == 4 ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE,
                 image.bytes.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

std::filesystem::path cache_file(const std::string& key) {
    const std::filesystem::path cache = user_folder("XDG_CACHE_HOME", ".cache");
    return cache.empty() ? cache : cache / "blush" / "thumbnails" / fmt::format("{:016x}.png", hash_of(key));
}

// Mean of a rectangle of pixels, bytes mapped to 0 .. 1.
Vec3 mean(const Image& image, int x0, int y0, int x1, int y1) {
    Vec3 sum{0, 0, 0};
    int count = 0;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            const size_t i = (size_t(y) * size_t(image.width) + size_t(x)) * size_t(image.channels);
            const auto value = [&](int channel) {
                const size_t k = i + size_t(image.channels >= 3 ? channel : 0);
                return image.floats.empty() ? float(image.bytes[k]) / 255 : image.floats[k];
            };
            const Vec3 c{value(0), value(1), value(2)};
            if (!std::isfinite(c.x + c.y + c.z)) continue;
            sum = sum + c;
            ++count;
        }
    return count > 0 ? sum * (1.f / float(count)) : sum;
}

float middle_grey_scale(const std::vector<Vec3>& pixels) {
    double sum = 0;
    int count = 0;
    for (const Vec3& c : pixels) {
        const float y = luminance(c);
        if (!(y > 0)) continue;
        sum += std::log(y);
        ++count;
    }
    return count > 0 ? 0.18f / float(std::exp(sum / count)) : 1;
}

} // namespace

std::vector<float> image_thumbnail(const Image& image) {
    constexpr int width = Thumbnail::width, height = Thumbnail::height;
    std::vector<float> rgb(size_t(width) * height * 3);
    const double scale = std::min(double(width) / image.width, double(height) / image.height);
    const int w = std::clamp(int(image.width * scale), 1, width), h = std::clamp(int(image.height * scale), 1, height);
    std::vector<Vec3> pixels;
    const auto at = [](int i, int count, int size) { return int(int64_t(i) * size / count); };
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const int x0 = at(x, w, image.width), y0 = at(y, h, image.height);
            pixels.push_back(
                mean(image, x0, y0, std::max(at(x + 1, w, image.width), x0 + 1), std::max(at(y + 1, h, image.height), y0 + 1)));
        }
    const float exposure = image.floats.empty() ? 1 : middle_grey_scale(pixels);
    for (int i = 0; i < w * h; ++i) {
        const Vec3 c = pixels[size_t(i)] * exposure;
        const size_t to = (size_t((height - h) / 2 + i / w) * width + size_t((width - w) / 2 + i % w)) * 3;
        for (int k = 0; k < 3; ++k) {
            const float v = std::clamp(k == 0 ? c.x : k == 1 ? c.y : c.z, 0.f, 1.f);
            rgb[to + size_t(k)] = image.floats.empty() ? v : srgb_from_linear(v);
        }
    }
    return rgb;
}

std::filesystem::path image_thumbnail_file(const std::filesystem::path& image) {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(image, error);
    const auto time = std::filesystem::last_write_time(image, error);
    return error ? std::filesystem::path() : cache_file(fmt::format("{}\n{}\n{}", image.string(), bytes, time.time_since_epoch().count()));
}

std::filesystem::path thumbnail_file(const std::filesystem::path& scene, const std::filesystem::path& assets) {
    std::error_code error;
    if (std::filesystem::equivalent(scene.parent_path(), assets / "scenes", error))
        return assets / "thumbnails" / (scene.stem().string() + ".png");
    return cache_file(scene.string());
}

Result<void> write_thumbnail(const std::filesystem::path& file, const Frame& frame, const ViewSettings& view,
                             const ColorManagement& color) {
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

GlTexture FileThumbnails::kept(const std::filesystem::path& thumbnail) const {
    constexpr int max_pixels_across = 1024; // limit, because a file in the cache may be invalid
    const Result<ImagePtr> image = read_image(thumbnail, {.max_side = max_pixels_across});
    const bool fits = image && !(**image).bytes.empty() && (**image).channels >= 3;
    return fits ? uploaded(**image) : GlTexture();
}

ImTextureID FileThumbnails::of(const std::string& file) {
    constexpr size_t max_textures = 1000; // about 50 KB each
    const auto known = textures_.find(file);
    if (known != textures_.end()) return texture_id(known->second.name());
    if (textures_.size() >= max_textures) textures_.clear();
    if (!matches(scene_files, file)) return image(file);
    return texture_id((textures_[file] = kept(thumbnail_file(file, assets_))).name());
}

// From the cache, or made from the image, which can take seconds.
ImTextureID FileThumbnails::image(const std::string& file) {
    if (job_) {
        const auto made = job_->take();
        if (!made) return {};
        job_.reset();
        textures_[making_] = kept(image_thumbnail_file(making_));
        if (making_ == file) return texture_id(textures_[file].name());
    }
    std::error_code missing;
    const std::filesystem::path thumbnail = image_thumbnail_file(file);
    if (thumbnail.empty()) return {};
    if (std::filesystem::exists(thumbnail, missing)) return texture_id((textures_[file] = kept(thumbnail)).name());
    making_ = file;
    job_ = std::make_unique<BackgroundJob<bool>>(
        "Thumbnail",
        [file, thumbnail](JobProgress&) {
            const Result<ImagePtr> image = read_image(file);
            if (!image || (**image).width <= 0 || (**image).height <= 0) return false;
            std::error_code error;
            std::filesystem::create_directories(thumbnail.parent_path(), error);
            return bool(write_display_image(thumbnail, Thumbnail::width, Thumbnail::height, image_thumbnail(**image)));
        },
        wake_);
    return {};
}

} // namespace blush
