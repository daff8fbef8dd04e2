// Bounces: the picture taken apart by how often light was scattered. Looking at them renders nothing anew.
#include "measure/bounce_energy.h"
#include "ui/bars.h"
#include "ui/panels/panels.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

using Mode = BouncesView::Mode;

void draw_playing(PanelContext& c, Fields& f, BouncesView& view, int planes) {
    int64_t bounce = view.bounce;
    if (f.integer("Bounce", bounce, 0, planes - 1, 1,
                  "0 glows in view, 1 is direct light, 2 the first colour bleeding; the last holds all further ones.")) {
        view.bounce = int(bounce);
        view.playing = false;
    }
    if (f.button(view.playing ? "Stop" : "Play", "Shows one after the other.")) {
        view.playing = !view.playing;
        view.step_due = ImGui::GetTime() + BouncesView::seconds_each;
    }
    if (view.playing) c.ui.next_frame_in = std::min(c.ui.next_frame_in, play(view, ImGui::GetTime(), planes));
}

void draw_gains(Fields& f, BouncesView& view, const std::vector<BounceEnergy>& energies) {
    view.gains.resize(energies.size(), 1.f);
    for (size_t k = 0; k < energies.size(); ++k)
        f.number(fmt::format("Bounce {}", energies[k].name).c_str(), view.gains[k],
                 {.min = 0, .max = most_bounce_gain, .reset = 1, .unit = "×", .bar = true, .tip = "A demonstration: only 1 is true.", .format = "%.2f"});
    if (f.button("All 1", "Back to the true picture.")) view.gains.assign(energies.size(), 1.f);
}

void draw_energy(PanelContext& c, BouncesView& view, const std::vector<BounceEnergy>& energies) {
    const std::vector<float> gains = gains_of(view, int(energies.size()));
    std::vector<Bar> bars;
    double direct = 0;
    for (size_t k = 0; k < energies.size(); ++k) {
        const BounceEnergy& e = energies[k];
        bars.push_back({fmt::format("Bounce {}", e.name), e.share, fmt::format("{:.2f} %", 100 * e.share),
                        view.mode != Mode::picture && gains[k] != 0});
        if (k <= 1) direct += e.share;
    }
    const int clicked = draw_bars(c.ui, "Energy", bars, "Its share of the picture's luminance. A click shows it alone.");
    if (clicked >= 0) {
        view.mode = Mode::single;
        view.bounce = clicked;
        view.playing = false;
    }
    if (is_mixed(c.mixing ? c.mixing->gains : c.frame->gains))
        quiet_text("The bounces show the light as it was before the light mix.");
    quiet_text(fmt::format("Direct {:.1f} %, indirect {:.1f} % of the picture's light.", 100 * direct, 100 * (1 - direct)));
}

} // namespace

void draw_bounces_panel(PanelContext& c) {
    BouncesView& view = c.ui.bounces;
    const std::vector<BounceEnergy> energies = c.frame ? bounce_energy(*c.frame) : std::vector<BounceEnergy>();
    if (energies.empty()) return quiet_text("Waiting for a picture with bounces in it.");
    Fields f(c.ui, "Bounces");
    int mode = int(view.mode);
    if (f.choice("Show", mode, BouncesView::names,
                 "What the viewport shows. Nothing is rendered again for it, and nothing of it is saved.")) {
        view.mode = Mode(mode);
        view.playing = false;
    }
    if (view.steps()) draw_playing(c, f, view, int(energies.size()));
    if (view.mode == Mode::gains) draw_gains(f, view, energies);
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.4f});
    draw_energy(c, view, energies);
}

} // namespace blush
