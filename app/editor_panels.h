// Draws the panels round the picture and the windows above it, in their order.
#pragma once

#include "ui/layout.h"
#include "ui/panels/context.h"
#include "ui/waveform_sheet.h"

namespace blush {

// Outliner, time row and inspector in their regions, then the panels that change lights: they come before the picture, so that it
// shows their edits in the same frame.
void draw_side_panels(PanelContext& c, const Layout& layout);

// The instruments: panels that measure or compare the picture, drawn after it.
class InstrumentPanels {
public:
    void draw(PanelContext& c);

private:
    WaveformSheet waveforms_;
};

} // namespace blush
