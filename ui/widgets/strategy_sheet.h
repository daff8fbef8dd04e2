// The images and maps of the Strategies panel as one texture.
#pragma once

#include "ui/gl/display_pass.h"
#include "ui/views/strategies_view.h"

#include <imgui.h>

#include <optional>

namespace blush {

class StrategySheet {
public:
    void set_shader(const DisplayShader& shader);
    // Follows the report: images through the display transform, maps in their own colours. Returns false while the images are not
    // finished: they take several frames with a software rasterizer. Requires a current context.
    bool update(const StrategiesView& view, const DisplayParameters& numbers);
    // The three images one below the other, first row on top; 0: nothing to draw.
    ImTextureID texture() const { return texture_; }

private:
    bool update_images(const StrategiesView& view, bool same, const DisplayParameters& numbers);
    void update_maps(const StrategyReport& report, StrategiesView::Show show);

    DisplayPass pass_;
    GlTexture maps_;
    std::optional<DisplayShader> shader_;
    bool shader_changed_ = false;
    StrategyWork::Output drawn_; // the report in the texture, or that is being drawn
    StrategiesView::Show show_ = StrategiesView::Show::image;
    DisplayLook look_;
    ImTextureID texture_ = {};
};

} // namespace blush
