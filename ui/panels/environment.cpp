// Environment: what surrounds the scene and lights it from all sides.
#include "ui/panels/panels.h"
#include "ui/widgets.h"

#include <filesystem>
#include <fmt/format.h>

namespace blush {

void draw_environment_panel(PanelContext& c) {
    static constexpr const char* kinds[] = {"None", "Constant", "Image"};
    Environment e = c.scene().environment;
    Fields f(c.ui, "Environment");
    int kind = int(e.kind);
    if (f.choice("Type", kind, kinds,
                 "What lies beyond the scene: nothing, one colour, or a panorama that lights it as the place where it was taken.")) {
        if (Environment::Kind(kind) == Environment::Kind::image && !e.image)
            c.ui.commands.push_back(Command::environment);
        else
            e.kind = Environment::Kind(kind);
    }
    if (e.kind == Environment::Kind::image) {
        f.info("Image",
               fmt::format("{}{}", std::filesystem::path(e.file).filename().string(),
                           e.image ? fmt::format("  {} × {}", e.image->width, e.image->height) : ""),
               e.file.c_str());
        if (f.button("Choose image...", "A panorama in latitude and longitude: Radiance .hdr or OpenEXR .exr."))
            c.ui.commands.push_back(Command::environment);
    }
    if (e.kind != Environment::Kind::none) {
        const bool constant = e.kind == Environment::Kind::constant;
        f.number("Intensity", e.intensity,
                 {.min = 0,
                  .max = 1e9f,
                  .reset = 1,
                  .unit = constant ? "nits" : "×",
                  .tip = constant ? "Luminance of the surround for a white colour." : "Multiplies the image. 1 takes its values as nits."});
        f.color(constant ? "Colour" : "Tint", e.color, {1, 1, 1},
                constant ? "Linear RGB (Rec.709) of the surround." : "Linear RGB (Rec.709) that multiplies the image.");
        if (!constant)
            f.number("Rotation", e.rotation_degrees,
                     {.min = -180,
                      .max = 180,
                      .reset = 0,
                      .unit = "°",
                      .bar = true,
                      .tip = "Turns the panorama about the vertical axis.",
                      .format = "%.1f"});
        f.checkbox("Seen by camera", e.visible_to_camera, "Show the surround behind the scene. It lights the scene either way.");
    }
    if (f.changed()) c.apply(SetEnvironment{e}, f.gesture());
}

} // namespace blush
