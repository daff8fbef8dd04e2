// Images or maps of a report, one below the other in one texture, for panels that compare renders.
#pragma once

#include "ui/gl/display_pass.h"

#include <imgui.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace blush {

// A report with the part of it that a panel shows: another one is drawn anew. Keeps the report alive.
struct SheetSource {
    std::shared_ptr<const void> report;
    int show = 0;
    bool operator==(const SheetSource&) const = default;
};

class ImageSheet {
public:
    void set_shader(const DisplayShader& shader);
    // Scene-linear images of this size through the display transform. Returns false while they are not finished: they take several
    // frames with a software rasterizer. Requires a current context, as show_texels() does.
    bool show_images(const SheetSource& source, int width, int height, const std::function<std::vector<std::span<const Vec3>>()>& images,
                     const DisplayParameters& numbers);
    // RGBA bytes, `width` a row, top row first; empty: there is nothing to draw.
    void show_texels(const SheetSource& source, int width, const std::function<std::vector<uint32_t>()>& texels);
    void clear();
    // First row on top; 0: nothing to draw.
    ImTextureID texture() const { return texture_; }

private:
    DisplayPass pass_;
    GlTexture texels_;
    std::optional<DisplayShader> shader_;
    bool shader_changed_ = false;
    SheetSource drawn_; // in the texture, or being drawn
    DisplayLook look_;
    ImTextureID texture_ = {};
};

} // namespace blush
