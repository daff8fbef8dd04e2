#include "ui/widgets/strategy_sheet.h"

#include "ui/gl/texture_id.h"

#include <utility>
#include <vector>

namespace blush {
namespace {

constexpr double milliseconds_per_frame = 6;

std::vector<float> stacked(const StrategyReport& report) {
    std::vector<float> rgba;
    for (const StrategySide& side : report.sides)
        for (const Vec3& p : side.image) rgba.insert(rgba.end(), {p.x, p.y, p.z, 1});
    return rgba;
}

} // namespace

void StrategySheet::set_shader(const DisplayShader& shader) {
    shader_ = shader;
    shader_changed_ = true;
}

bool StrategySheet::update(const StrategiesView& view, const DisplayParameters& numbers) {
    const StrategyWork::Output& report = view.state.output;
    if (!view.open || !report) {
        drawn_.reset();
        texture_ = {};
        return true;
    }
    const bool same = report == drawn_ && view.show == show_;
    if (view.show == StrategiesView::Show::image) return update_images(view, same, numbers);
    if (!same) update_maps(*report, view.show);
    drawn_ = report;
    show_ = view.show;
    return true;
}

bool StrategySheet::update_images(const StrategiesView& view, bool same, const DisplayParameters& numbers) {
    if (!shader_) return true;
    DisplayLook look{numbers, {}};
    look.numbers.false_color = {}; // as for thumbnails: the images should be recognisable, and have no albedo for lux
    if (!pass_.busy() && (!same || shader_changed_ || look != look_)) {
        if (std::exchange(shader_changed_, false) && !pass_.set_shader(*shader_)) return true; // the viewport reports the error
        const StrategyReport& report = *view.state.output;
        pass_.upload(report.width, 3 * report.height, stacked(report));
        pass_.begin(look);
        drawn_ = view.state.output;
        show_ = view.show;
        look_ = look;
    }
    pass_.advance(milliseconds_per_frame);
    if (pass_.busy()) return false;
    texture_ = texture_id(pass_.texture());
    return true;
}

void StrategySheet::update_maps(const StrategyReport& report, StrategiesView::Show show) {
    const std::vector<uint32_t> texels = strategy_texels(report, show);
    texture_ = {};
    if (texels.empty()) return;
    if (!maps_) maps_ = GlTexture::create();
    glBindTexture(GL_TEXTURE_2D, maps_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, report.width, 3 * report.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    textures_changed();
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    texture_ = texture_id(maps_.name());
}

} // namespace blush
