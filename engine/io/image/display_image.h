// Applies view settings to images: converts them to the parameters of the display transform.
#pragma once

#include "color/color_management.h"
#include "scene/view_settings.h"

#include <span>

namespace blush {

DisplayTransform transform_of(const ViewSettings& view);
DisplayParameters display_parameters_of(const ViewSettings& view);

// Exposure in stops that auto exposure meters from an image of `channels` values per pixel (exposure_meter.h); 0 if off.
float metered_exposure(AutoExposure rule, std::span<const float> values, int channels);
// The same settings without auto exposure: `metered_ev` is added to the exposure.
ViewSettings settled(const ViewSettings& view, float metered_ev);

// Stops of a scene-linear colour's luminance from middle grey (0.18), after white balance and exposure of `numbers`: the value
// that false colour in stops shows. -infinity or NaN for black and negative values.
float stops_from_grey(const DisplayParameters& numbers, const Vec3& scene);

// The same scale with ends fitted to the values of an image in its unit (exposure_meter.h), rounded outwards to 1, 2 or 5 times a
// power of ten. Unchanged if the image is black.
FalseColor fitted(const FalseColor& scale, std::span<const float> values, int channels);

// Additional planes that some view settings need, one value per pixel; empty if missing.
struct DisplayPlanes {
    std::span<const Vec3> albedo = {};    // for false colour in lux
    std::span<const float> coverage = {}; // of objects (coverage.h), for background_as_it_is; empty: all objects
};

// Applies the display transform to scene-linear `rgb` (3 values per pixel) in place.
// Errors: unknown display, view or look; lux without albedo.
Result<void> show(const ColorManagement& color, const ViewSettings& view, std::span<float> rgb, const DisplayPlanes& with = {});

} // namespace blush
