// Display: how the finished image is looked at. Nothing here restarts the render.
#include "ui/panels/panels.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

void draw_denoised_figures(Fields& f, const DenoisedPicture& picture) {
    const Denoised& d = picture.denoised;
    f.info("Network", fmt::format("{}, {}", d.network, d.precision), "What denoised the picture, and with which arithmetic.");
    f.info("Took", fmt::format("{:.0f} ms", 1000 * d.seconds),
           "Denoising goes on beside the rendering and takes a tenth of the time at most, but for the first picture and the last.");
    f.info("Mean energy", fmt::format("{:+.2f} %", energy_change_percent(d)),
           "By how much the denoiser changed the mean luminance. The estimated error is always that of the raw image.");
    if (d.sanitised > 0)
        f.info("Sanitised", fmt::format("{} pixels", d.sanitised),
               "Pixels that no network could be given as they were: not finite, negative, or far too bright.");
}

void draw_denoise_fields(PanelContext& c) {
    constexpr const char* names[] = {"Raw", "Denoised", "Blend", "Difference"};
    DenoiseView& view = c.ui.denoise;
    ImGui::BeginDisabled(!c.denoiser_problem.empty());
    Fields f(c.ui, "Denoise");
    int show = int(view.show);
    if (f.choice("Show", show, names,
                 "The image as it was traced, its denoised picture, something between them, or by how much they differ. Nothing is "
                 "rendered again."))
        view.show = DenoiseView::Show(show);
    if (view.show == DenoiseView::Show::blend)
        f.number("Blend", view.blend,
                 {.min = 0, .max = 1, .reset = 0.5f, .bar = true, .tip = "0 is the raw image, 1 the denoised one.", .format = "%.2f"});
    if (view.wants_denoised() && c.denoised) draw_denoised_figures(f, *c.denoised);
    ImGui::EndDisabled();
    if (!c.denoiser_problem.empty())
        quiet_text(c.denoiser_problem);
    else if (!view.wants_denoised())
        quiet_text("The image is shown as it was traced, noise included.");
}

} // namespace

void draw_display_panel(PanelContext& c) {
    ViewSettings v = c.project().view;
    Fields f(c.ui, "Display");
    std::string display = v.display.empty() ? c.color.default_display() : v.display;
    if (f.choice("Display", display, c.color.displays(), "The screen that the image is encoded for.")) {
        v.display = display;
        v.view.clear();
    }
    std::string view = v.view.empty() ? c.color.default_view(display) : v.view;
    if (f.choice("View", view, c.color.views(display),
                 "How scene light becomes display light: a film-like curve, none, or false colours that show exposure."))
        v.view = view;
    f.number("Exposure", v.exposure_ev,
             {.min = -20,
              .max = 20,
              .reset = 0,
              .unit = "EV",
              .step = 0.02f,
              .tip = "Each EV doubles the brightness of the picture as shown.",
              .format = "%+.2f"});
    f.number("Gamma", v.gamma,
             {.min = 0.2f,
              .max = 5,
              .reset = 1,
              .step = 0.005f,
              .tip = "Bends the picture after the view: above 1 lifts the shadows. For looking into dark corners, not for saving.",
              .format = "%.2f"});
    f.info("Colours from", c.color.config_name(), "The OpenColorIO configuration in use. The variable OCIO chooses another.");
    if (f.changed()) c.apply(SetView{v}, f.gesture());

    if (section(c.ui, "Denoise")) draw_denoise_fields(c);
}

} // namespace blush
