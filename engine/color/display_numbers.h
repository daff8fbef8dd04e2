// What of the display stage is a number or a name; engine/color knows no settings of the document.
#pragma once

#include "color/false_color.h"
#include "core/vec.h"

#include <string>

namespace blush {

// What a shader is made for. Empty names mean the config's default display, the display's default view, and the looks that the view has of
// itself.
struct DisplayTransform {
    std::string display = {}, view = {}, look = {};
    bool operator==(const DisplayTransform&) const = default;
};

// All else: the uniforms of the shader. In this order: white balance, exposure, look and view, gamma; false colours take the place of what
// comes after the exposure.
struct DisplayNumbers {
    float exposure_ev = 0;
    float gamma = 1;
    Affine white_balance = {}; // of scene-linear values; its translation is not used
    FalseColorScale false_color = {};
    bool background_as_it_is = false; // what the camera sees past all objects is clipped and sRGB-encoded, and nothing else
    bool operator==(const DisplayNumbers&) const = default;
};

} // namespace blush
