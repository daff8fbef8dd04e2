// How the bounce planes are looked at: one, all up to one, direct against indirect light, each with a gain, or one after the other.
#pragma once

#include "ui/picture_view.h"

namespace blush {

constexpr float most_bounce_gain = 4;

struct BouncesView {
    enum class Mode { picture, single, cumulative, direct, indirect, gains };
    static constexpr const char* names[] = {"Picture", "One bounce", "Up to a bounce", "Direct light", "Indirect light", "Gains"};
    static constexpr double seconds_each = 0.8; // while playing

    bool open = false; // the panel; while it is, the film holds the planes
    Mode mode = Mode::picture;
    int bounce = 1; // of single and cumulative
    std::vector<float> gains;
    bool playing = false;
    double step_due = 0; // when the next bounce is shown

    // There are bounces to step through.
    bool steps() const { return mode == Mode::single || mode == Mode::cumulative; }
};

// The gain of each of so many planes; direct light is what glows in view and what was scattered once.
std::vector<float> gains_of(const BouncesView& view, int planes);
PictureView picture_view(const BouncesView& view, int planes);
// Goes on to the next bounce, the first after the last, when that is due. Returns seconds until the one after it.
double play(BouncesView& view, double now, int planes);

} // namespace blush
