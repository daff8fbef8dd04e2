// Parameters of the display transform, independent of the document's settings.
#pragma once

#include "color/false_color.h"
#include "core/vec.h"

#include <string>

namespace blush {

// Names that select the shader. Empty: the config's default display, the display's default view, and the view's own looks.
struct DisplayTransform {
    std::string display = {}, view = {}, look = {};
    bool operator==(const DisplayTransform&) const = default;
};

// Uniforms of the shader. Order of operations: white balance, exposure, look
// and view, gamma; false colours replace everything after the exposure.
struct DisplayParameters {
    float exposure_ev = 0;
    float gamma = 1;
    Affine white_balance = {}; // of scene-linear values; its translation is ignored
    FalseColorScale false_color = {};
    bool background_as_it_is = false; // the background behind all objects is only clipped and sRGB-encoded
    bool operator==(const DisplayParameters&) const = default;
    // False if the shader without ALL_STEPS gives the same colours (DisplayShader in color_management.h).
    bool needs_all_steps() const { return gamma != 1 || false_color.of != FalseColorScale::Of::off || background_as_it_is; }
};

} // namespace blush
