#include "ui/widgets/image_sheet.h"

#include "ui/gl/texture_id.h"

#include <utility>

namespace blush {
namespace {

constexpr double milliseconds_per_frame = 6;

std::vector<float> stacked(const std::vector<std::span<const Vec3>>& images) {
    std::vector<float> rgba;
    for (const std::span<const Vec3>& image : images)
        for (const Vec3& p : image) rgba.insert(rgba.end(), {p.x, p.y, p.z, 1});
    return rgba;
}

} // namespace

void ImageSheet::set_shader(const DisplayShader& shader) {
    shader_ = shader;
    shader_changed_ = true;
}

void ImageSheet::clear() {
    drawn_ = {};
    texture_ = {};
}

bool ImageSheet::show_images(const SheetSource& source, int width, int height,
                             const std::function<std::vector<std::span<const Vec3>>()>& images, const DisplayParameters& numbers) {
    if (!shader_) return true;
    DisplayLook look{numbers, {}};
    look.numbers.false_color = {}; // as for thumbnails: the images should be recognisable, and have no albedo for lux
    if (!pass_.busy() && (source != drawn_ || shader_changed_ || look != look_)) {
        if (std::exchange(shader_changed_, false) && !pass_.set_shader(*shader_)) return true; // the viewport reports the error
        const auto all = images();
        pass_.upload(width, height * int(all.size()), stacked(all));
        pass_.begin(look);
        drawn_ = source;
        look_ = look;
    }
    pass_.advance(milliseconds_per_frame);
    if (pass_.busy()) return false;
    texture_ = texture_id(pass_.texture());
    return true;
}

void ImageSheet::show_texels(const SheetSource& source, int width, const std::function<std::vector<uint32_t>()>& texels) {
    if (source == drawn_) return;
    drawn_ = source;
    texture_ = {};
    const std::vector<uint32_t> all = texels();
    if (all.empty()) return;
    if (!texels_) texels_ = GlTexture::create();
    glBindTexture(GL_TEXTURE_2D, texels_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, int(all.size()) / width, 0, GL_RGBA, GL_UNSIGNED_BYTE, all.data());
    textures_changed();
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    texture_ = texture_id(texels_.name());
}

} // namespace blush
