// Histograms and waveforms of the picture that is shown, made beside the window.
#pragma once

#include "measure/scopes.h"
#include "ui/background_answer.h"
#include "ui/shown_picture.h"

namespace blush {

struct Scopes {
    int step = 1;               // every step-th pixel of every step-th row was read
    Histogram scene, displayed; // in stops from middle grey as rendered; display-encoded, 0 .. 1, nothing if the view cannot be had
    Waveform scene_wave, displayed_wave;
};
// Reads a hundred thousand pixels or so.
Scopes scopes_of(const ShownPicture& picture);

// State of the panel.
struct ScopesView {
    bool open = false;
    BackgroundAnswer<ShownPicture, Scopes> scopes;
};

} // namespace blush
