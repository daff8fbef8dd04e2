#include "ui/widgets/waveform_sheet.h"

#include "ui/gl/texture_id.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

void upload(GlTexture& texture, const Waveform& waveform) {
    if (waveform.columns == 0) return void(texture = {});
    if (!texture) texture = GlTexture::create();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, waveform.columns, waveform.levels, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 waveform_texels(waveform).data());
    textures_changed();
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

} // namespace

std::vector<uint32_t> waveform_texels(const Waveform& w) {
    std::vector<uint32_t> texels(size_t(w.columns) * size_t(w.levels));
    for (int level = 0; level < w.levels; ++level) {
        for (int column = 0; column < w.columns; ++column) {
            const size_t from = size_t(level) * size_t(w.columns) + size_t(column);
            int shade[3];
            for (size_t k = 0; k < 3; ++k)
                shade[k] = w.counts[k][from] == 0 ? 0 : std::min(40 + int(30 * std::sqrt(float(w.counts[k][from]))), 255);
            const bool any = shade[0] + shade[1] + shade[2] > 0;
            texels[size_t(w.levels - 1 - level) * size_t(w.columns) + size_t(column)] =
                any ? uint32_t(IM_COL32(shade[0], shade[1], shade[2], 255)) : 0;
        }
    }
    return texels;
}

void WaveformSheet::update(const ScopesView& view) {
    if (!view.open || view.scopes.number() == result_) return;
    result_ = view.scopes.number();
    upload(scene_, view.scopes.output()->scene_wave);
    upload(displayed_, view.scopes.output()->displayed_wave);
}

WaveformTextures WaveformSheet::textures() const { return {texture_id(scene_.name()), texture_id(displayed_.name())}; }

} // namespace blush
