// Histograms and waveforms of the displayed image, computed in the background.
#pragma once

#include "measure/metrics/scopes.h"
#include "ui/jobs/async_query.h"
#include "ui/views/shown_image.h"

namespace blush {

struct Scopes {
    int step = 1;               // every step-th pixel of every step-th row was read
    Histogram scene, displayed; // in stops from middle grey; display-encoded, 0 .. 1, empty if the view transform fails
    Waveform scene_wave, displayed_wave;
};
// Reads about a hundred thousand pixels.
Scopes scopes_of(const ShownImage& image);

// State of the panel.
struct ScopesView {
    bool open = false;
    AsyncQuery<ShownImage, Scopes> scopes;
};

} // namespace blush
