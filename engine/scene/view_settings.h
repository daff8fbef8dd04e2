// Display settings of the rendered image. They do not reach the render session, so that changes never restart rendering.
#pragma once

#include "core/result.h"
#include "core/vec.h"
#include "scene/image_region.h"
#include "scene/lights/light_meter.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// Auto exposure. Unless off, `exposure_ev` is a compensation that is added to the metered exposure.
enum class AutoExposure : uint8_t {
    off,
    average,    // log-average luminance maps to middle grey
    highlights, // the brightest 1 % of pixels lies above white
};

// False colour: maps luminance or illuminance to a colour scale.
struct FalseColor {
    enum class Of : uint8_t {
        off,
        stops, // stops from middle grey after exposure: -6.5 .. +6.5
        nits,  // luminance
        lux,   // illuminance from luminance and albedo: valid for diffuse surfaces
    };
    Of of = Of::off;
    float low = 1, high = 1000; // ends of the scale of nits and lux
    bool operator==(const FalseColor&) const = default;
};

struct ViewSettings {
    float exposure_ev = 0;
    float gamma = 1;
    std::string display = {}; // empty: the config's default
    std::string view = {};    // empty: the display's default
    std::string look = {};    // empty: the view's default
    AutoExposure auto_exposure = AutoExposure::off;
    Vec3 white{1, 1, 1}; // white balance: scene-linear colour that is shown neutral
    FalseColor false_color = {};
    bool background_as_it_is = false;         // backdrop pixels are only encoded: no exposure, white balance, look or view transform
    std::optional<ImageRegion> measured = {}; // region whose statistics are shown
    std::vector<LightMeter> meters = {};
    std::optional<float> frame_aspect = {}; // width / height of the camera frame; 0: no frame; empty: the camera's own
    bool lock_camera = false;               // navigation moves the camera that the view looks through
    bool operator==(const ViewSettings&) const = default;
};

Result<AutoExposure> parse_auto_exposure(std::string_view text); // "off", "average", "highlights"
std::string_view to_string(AutoExposure rule);
// "off", "stops", "nits", "nits=1:1000", "lux=10:2000".
Result<FalseColor> parse_false_color(std::string_view text);
std::string to_string(const FalseColor& scale);
// "1,0.9,0.8": components from 0, not all of them 0.
Result<Vec3> parse_white(std::string_view text);

} // namespace blush
