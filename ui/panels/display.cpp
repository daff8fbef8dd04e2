// Display tab: denoising, view transform, exposure and white balance of the displayed image. Nothing here restarts the render.
#include "core/math.h"
#include "core/text.h"
#include "scene/lights/color_temperature.h"
#include "ui/panels/panels.h"
#include "ui/snapshots/image_pixels.h"
#include "ui/widgets/widgets.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

void draw_denoised_figures(Fields& f, const DenoisedImage& image) {
    const Denoised& d = image.denoised;
    f.info("Network", fmt::format("{}, {}", d.network, d.precision), "The network that denoised the image, and its numeric precision.");
    f.info("Bias", d.bias_corrected ? "corrected" : "not corrected",
           "The network shifts colours, dims lamps and blurs small highlights. From two samples on, what noise cannot explain of that is "
           "taken back. Where there is no noise, the denoised image is the raw one. Images with a shadow catcher are not corrected.");
    f.info("Denoise time", fmt::format("{:.0f} ms", 1000 * d.seconds),
           "Denoising runs in parallel with rendering and takes at most a tenth of the time, except while the samples are few, and for the "
           "last image.");
    f.info("Mean energy", signed_number(energy_change_percent(d), 2) + " %",
           "Change of the mean luminance by the denoiser. The estimated error is always that of the raw image.");
    if (d.sanitised > 0)
        f.info("Replaced", fmt::format("{} pixels", d.sanitised),
               "Pixels that were not finite, negative or far too bright. They were replaced before denoising.");
}

void draw_denoise_fields(PanelContext& c) {
    constexpr const char* names[] = {"Raw", "Denoised", "Blend", "Difference"};
    DenoiseView& view = c.ui.denoise;
    ImGui::BeginDisabled(!c.denoiser_problem.empty());
    Fields f(c.ui, "Denoise");
    int show = int(view.show);
    if (f.choice("Show", show, names,
                 "Raw: the rendered image. Denoised: the output of the denoiser. Blend: a mix of both. Difference: |raw - denoised|. "
                 "The render does not restart."))
        view.show = DenoiseView::Show(show);
    if (view.show == DenoiseView::Show::blend)
        f.number("Blend", view.blend,
                 {.min = 0, .max = 1, .reset = 0.5f, .bar = true, .tip = "0 is the raw image, 1 the denoised one.", .format = "%.2f"});
    if (view.wants_denoised() && c.denoised) draw_denoised_figures(f, *c.denoised);
    ImGui::EndDisabled();
    if (!c.denoiser_problem.empty())
        quiet_text(c.denoiser_problem);
    else if (!view.wants_denoised())
        quiet_text("The raw image is shown, without denoising.");
}

// The display transform: from scene-linear to display values.
void draw_transform_fields(PanelContext& c, Fields& f, ViewSettings& v) {
    std::string display = v.display.empty() ? c.color.default_display() : v.display;
    if (f.choice("Display", display, c.color.displays(), "The display that the image is encoded for.")) {
        v.display = display;
        v.view.clear();
    }
    std::string view = v.view.empty() ? c.color.default_view(display) : v.view;
    if (f.choice("View", view, c.color.views(display),
                 "The view transform: from scene-linear to display values, with tone mapping or without."))
        v.view = view;
    static constexpr const char* no_look = "View's default";
    std::vector<std::string> looks = c.color.looks();
    looks.insert(looks.begin(), no_look);
    std::string look = v.look.empty() ? no_look : v.look;
    if (f.choice("Look", look, looks, "A grade that is applied before the view transform, for example contrast."))
        v.look = look == no_look ? "" : look;
    f.checkbox("Backdrop as it is", v.background_as_it_is,
               "Do not apply exposure, white balance, look and view transform to the background: a backdrop image keeps its own colours.");
    f.info("Colours from", c.color.config_name(),
           "The OpenColorIO configuration in use. Set the environment variable OCIO to use another.");
}

void draw_exposure_fields(PanelContext& c, Fields& f, ViewSettings& v) {
    constexpr const char* names[] = {"Manual", "Mean to middle grey", "Highlights to white"};
    const bool by_hand = v.auto_exposure == AutoExposure::off;
    f.number(by_hand ? "Exposure" : "Compensation", v.exposure_ev,
             {.min = -20,
              .max = 20,
              .reset = 0,
              .unit = "EV",
              .step = 0.02f,
              .tip = "Each EV doubles the displayed brightness. In the viewport: E+drag or Alt+wheel.",
              .format = "%+.2f"});
    int rule = int(v.auto_exposure);
    if (f.choice("Auto exposure", rule, names,
                 "Manual, or computed from the current image: its log-average luminance becomes middle grey (0.18), or the brightest one "
                 "per cent "
                 "of its pixels is above white (1).")) {
        if (by_hand || rule == int(AutoExposure::off)) v.exposure_ev = rule == int(AutoExposure::off) ? c.shown_view().exposure_ev : 0;
        v.auto_exposure = AutoExposure(rule);
    }
    if (v.auto_exposure != AutoExposure::off) f.info("Exposure", signed_number(c.shown_view().exposure_ev, 2) + " EV");
    if (f.button("Meter once", "Sets the exposure once, from the log-average luminance of the current image."))
        c.ui.commands.push_back(Command::exposure_meter);
    f.number("Gamma", v.gamma,
             {.min = 0.2f,
              .max = 5,
              .reset = 1,
              .step = 0.005f,
              .tip = "Gamma after the view transform: above 1 lifts the shadows. For inspecting dark regions, not for final images.",
              .format = "%.2f"});
}

void draw_white_temperature(PanelContext& c, Fields& f, ViewSettings& v) {
    WhiteFields& white = c.ui.white;
    const ColorTemperature neutral;
    if (white.color != v.white) {
        // Not computed for no white balance: 6504 K must be that exactly.
        const ColorTemperature t = v.white == Vec3{1, 1, 1} ? neutral : temperature_of(v.white);
        white = {v.white, t.kelvin, t.green_tint};
    }
    bool changed = f.number(
        "Temperature", white.kelvin,
        {.min = min_kelvin,
         .max = max_kelvin,
         .reset = neutral.kelvin,
         .unit = "K",
         .step = 10,
         .tip = "Colour temperature that is shown as white: bulbs 2700 K, noon sun 5500 K, shade 8000 K. 6504 K is no white balance.",
         .format = "%.0f"});
    changed |= f.number("Green tint", white.green_tint,
                        {.min = -0.05f,
                         .max = 0.05f,
                         .reset = neutral.green_tint,
                         .step = 0.0002f,
                         .tip = "Distance of the white from the black body colours in CIE 1960 uv (Duv). Daylight has 0.0032.",
                         .format = "%+.4f"});
    if (!changed) return;
    const bool as_rendered = white.kelvin == neutral.kelvin && white.green_tint == neutral.green_tint;
    const Vec3 color = black_body_color(white.kelvin, white.green_tint);
    v.white = white.color = as_rendered ? Vec3{1, 1, 1} : Vec3{std::max(color.x, 0.f), std::max(color.y, 0.f), std::max(color.z, 0.f)};
}

void draw_white_fields(PanelContext& c, Fields& f, ViewSettings& v) {
    draw_white_temperature(c, f, v);
    f.color("White", v.white, {1, 1, 1}, "The colour that is shown as neutral white (chromatic adaptation). EXR files do not change.");
    if (v.white.x + v.white.y + v.white.z <= 0) v.white = {1, 1, 1};
    if (f.button("Pick in the image", "Click a place in the image that should be white or grey."))
        c.ui.commands.push_back(Command::pick_white);
    if (v.white != Vec3{1, 1, 1} && f.button("As rendered", "No white balance.")) c.ui.commands.push_back(Command::reset_white);
}

// The range of the image's values, for Fit to the image.
FalseColor fitted_to_image(const PanelContext& c, const FalseColor& scale) {
    if (scale.of == FalseColor::Of::nits) return fitted(scale, c.frame->rgba, 4);
    return fitted(scale, pixels_of(*c.frame, {ImageView::Show::illuminance}), 4);
}

void draw_false_color_fields(PanelContext& c, Fields& f, ViewSettings& v) {
    FalseColor& scale = v.false_color;
    constexpr const char* names[] = {"Off", "Stops from grey", "Luminance", "Illuminance"};
    int of = int(scale.of);
    if (f.choice(
            "Show", of, names,
            "Stops from middle grey after exposure, luminance in nits, or illuminance in lux. Illuminance is computed from luminance and "
            "albedo: it "
            "is valid for diffuse surfaces."))
        scale.of = FalseColor::Of(of);
    if (scale.of != FalseColor::Of::nits && scale.of != FalseColor::Of::lux) return;
    const char* unit = scale.of == FalseColor::Of::nits ? "nits" : "lux";
    f.number(
        "From", scale.low,
        {.min = 1e-6f, .max = scale.high * 0.999f, .reset = 1, .unit = unit, .tip = "Lower end of the scale. Smaller values are black."});
    f.number(
        "To", scale.high,
        {.min = scale.low * 1.001f, .max = 1e9f, .reset = 1000, .unit = unit, .tip = "Upper end of the scale. Larger values are white."});
    if (f.button("Fit to the image", "Sets the range without the darkest and the brightest one per cent of the pixels.") && c.has_image()) {
        v.false_color = fitted_to_image(c, scale);
        c.apply(SetView{v});
    }
}

} // namespace

void draw_display_panel(PanelContext& c) {
    ViewSettings v = c.project().view;
    Fields f(c.ui, "Display");
    draw_transform_fields(c, f, v);
    if (section(c.ui, "Exposure")) draw_exposure_fields(c, f, v);
    if (section(c.ui, "White balance")) draw_white_fields(c, f, v);
    if (section(c.ui, "False colour")) draw_false_color_fields(c, f, v);
    if (f.changed()) c.apply(SetView{v}, f.gesture());

    if (section(c.ui, "Denoise")) draw_denoise_fields(c);
}

} // namespace blush
