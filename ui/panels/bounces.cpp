// Bounces panel: the image split by the number of scattering events. Changing the view does not restart the render.
#include "measure/statistics/bounce_energy.h"
#include "ui/panels/panels.h"
#include "ui/snapshots/image_pixels.h"
#include "ui/widgets/bars.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

using Mode = BouncesView::Mode;

void draw_playing(PanelContext& c, Fields& f, BouncesView& view, int planes) {
    int64_t bounce = view.bounce;
    if (f.integer("Bounce", bounce, 0, planes - 1, 1,
                  "0: emission seen directly. 1: direct light. 2: first indirect bounce. The last one holds all further bounces.")) {
        view.bounce = int(bounce);
        view.playing = false;
    }
    if (f.button(view.playing ? "Stop" : "Play", "Step through the bounces in a loop.")) {
        view.playing = !view.playing;
        view.step_due = ImGui::GetTime() + BouncesView::seconds_each;
    }
    if (view.playing) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, play(view, ImGui::GetTime(), planes));
}

void draw_gains(Fields& f, BouncesView& view, const std::vector<PlaneEnergy>& energies) {
    view.gains.resize(energies.size(), 1.f);
    for (size_t k = 0; k < energies.size(); ++k)
        f.number(fmt::format("Bounce {}", energies[k].name).c_str(), view.gains[k],
                 {.min = 0,
                  .max = max_bounce_gain,
                  .reset = 1,
                  .unit = "×",
                  .bar = true,
                  .tip = "Gain of this bounce, for demonstration. Only 1 is physically correct.",
                  .format = "%.2f"});
    if (f.button("All 1", "Reset all gains to 1.")) view.gains.assign(energies.size(), 1.f);
}

void draw_energy(PanelContext& c, BouncesView& view, const std::vector<PlaneEnergy>& energies) {
    const std::vector<float> gains = gains_of(view, int(energies.size()));
    std::vector<Bar> bars;
    double direct = 0;
    for (size_t k = 0; k < energies.size(); ++k) {
        const PlaneEnergy& e = energies[k];
        bars.push_back(
            {fmt::format("Bounce {}", e.name), e.share, fmt::format("{:.2f} %", 100 * e.share), view.mode != Mode::image && gains[k] != 0});
        if (k <= 1) direct += e.share;
    }
    const int clicked = draw_bars(c.ui, "Energy", bars, "Share of the image's luminance. Click to show this bounce alone.");
    if (clicked >= 0) {
        view.mode = Mode::single;
        view.bounce = clicked;
        view.playing = false;
    }
    if (is_mixed(c.mixing ? c.mixing->gains : c.frame->gains)) quiet_text("The bounce AOVs do not include the light mix.");
    quiet_text(fmt::format("Direct {:.1f} %, indirect {:.1f} % of the image's light.", 100 * direct, 100 * (1 - direct)));
}

} // namespace

void draw_bounces_panel(PanelContext& c) {
    BouncesView& view = c.ui.bounces;
    const std::vector<PlaneEnergy> energies = c.frame ? bounce_energy(*c.frame) : std::vector<PlaneEnergy>();
    if (energies.empty()) return quiet_text("Waiting for a render with bounce AOVs.");
    Fields f(c.ui, "Bounces");
    int mode = int(view.mode);
    if (f.choice("Show", mode, BouncesView::names, "What the viewport shows. It does not restart the render and is not saved.")) {
        view.mode = Mode(mode);
        view.playing = false;
    }
    if (view.steps()) draw_playing(c, f, view, int(energies.size()));
    if (view.mode == Mode::gains) draw_gains(f, view, energies);
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.4f});
    draw_energy(c, view, energies);
}

} // namespace blush
