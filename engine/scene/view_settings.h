// How the finished image is looked at. The render session never receives these: changing them restarts nothing.
#pragma once

#include "core/result.h"
#include "core/vec.h"
#include "scene/light_meter.h"
#include "scene/picture_region.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// Who sets the exposure. If not the user, `exposure_ev` is added to what is metered: a compensation.
enum class AutoExposure : uint8_t {
    off,
    average,    // the log-average luminance becomes middle grey
    highlights, // the brightest one per cent lies above white
};

// One colour for each step of luminance in place of the picture's own.
struct FalseColor {
    enum class Of : uint8_t {
        off,
        stops, // from middle grey, as exposed: -6.5 .. +6.5
        nits,  // luminance
        lux,   // illuminance, from luminance and albedo: true of matte surfaces
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
    std::string look = {};    // empty: what the view has of itself
    AutoExposure auto_exposure = AutoExposure::off;
    Vec3 white{1, 1, 1}; // scene-linear: the colour that is to look neutral
    FalseColor false_color = {};
    bool background_as_it_is = false; // the environment as the camera sees it is only encoded: no exposure, white balance, look or view
    std::optional<PictureRegion> measured = {}; // whose statistics are shown
    std::vector<LightMeter> meters = {};
    std::optional<float> frame_aspect = {}; // width over height of the camera's frame, 0: no frame; empty: what the camera has of itself
    bool lock_camera = false;               // navigating moves the camera that is looked through
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
