// View settings as the display stage takes them, and pictures as they are shown: the one place that knows both.
#pragma once

#include "color/color_management.h"
#include "scene/view_settings.h"

#include <span>

namespace blush {

DisplayTransform transform_of(const ViewSettings& view);
DisplayNumbers numbers_of(const ViewSettings& view);

// What auto exposure makes of a picture of `channels` values a pixel (exposure_meter.h); 0 if it is off.
float metered_exposure(AutoExposure rule, std::span<const float> values, int channels);
// The same look without auto exposure: `metered_ev` added to the exposure.
ViewSettings settled(const ViewSettings& view, float metered_ev);

// Stops of a scene-linear colour's luminance from middle grey, 0.18, as `numbers` balance and expose it: what false colours of stops show.
// Minus infinity or not a number for black and below.
float stops_from_grey(const DisplayNumbers& numbers, const Vec3& scene);

// The same scale with ends that hold nearly all of a picture (exposure_meter.h) whose values are in its unit, rounded outwards to 1, 2 or 5
// times a power of ten. As it is if the picture is black.
FalseColor fitted(const FalseColor& scale, std::span<const float> values, int channels);

// What some looks read beside the picture, a value a pixel; empty: not there.
struct ShownWith {
    std::span<const Vec3> albedo = {};    // false colours of lux
    std::span<const float> coverage = {}; // by objects (coverage.h): a background as it is. Without it everything is object
};

// Scene-linear `rgb`, 3 values a pixel, as it is shown, in place.
// Errors: unknown display, view or look; lux without albedo.
Result<void> show(const ColorManagement& color, const ViewSettings& view, std::span<float> rgb, const ShownWith& with = {});

} // namespace blush
