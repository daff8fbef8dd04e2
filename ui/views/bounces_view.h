// How the viewport shows the bounce AOVs: one bounce, all up to one, direct or indirect light, with a gain each, or in a loop.
#pragma once

#include "ui/snapshots/image_view.h"

namespace blush {

constexpr float max_bounce_gain = 4;

struct BouncesView {
    enum class Mode { image, single, cumulative, direct, indirect, gains };
    static constexpr const char* names[] = {"Image", "One bounce", "Up to a bounce", "Direct light", "Indirect light", "Gains"};
    static constexpr double seconds_each = 0.8; // while playing

    bool open = false; // the panel is open: the film then has the bounce planes
    Mode mode = Mode::image;
    int bounce = 1; // for single and cumulative
    std::vector<float> gains;
    bool playing = false;
    double step_due = 0; // time at which the next bounce is shown

    // True if the mode shows a single bounce that can be stepped.
    bool steps() const { return mode == Mode::single || mode == Mode::cumulative; }
};

// The gain of each of `n` planes. Direct light is emission seen directly plus bounce 1.
std::vector<float> gains_of(const BouncesView& view, int planes);
ImageView image_view(const BouncesView& view, int planes);
// Switches to the next bounce, cyclically, when it is due. Returns the seconds until the next switch.
double play(BouncesView& view, double now, int planes);

} // namespace blush
