// Display: how the finished image is looked at. Nothing here restarts the render.
#include "ui/panels/panels.h"
#include "ui/widgets.h"

#include <imgui.h>

namespace blush {

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

    if (!section(c.ui, "Denoise")) return;
    ImGui::BeginDisabled();
    bool denoise = false;
    Fields(c.ui, "Denoise").checkbox("Denoise", denoise, "");
    ImGui::EndDisabled();
    quiet_text("Not in this version. The image is shown as it was traced, noise included.");
}

} // namespace blush
