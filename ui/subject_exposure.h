// The exposure that shows the subject of a picture well: what a camera that meters what it is pointed at would choose.
#pragma once

#include "color/color_management.h"
#include "render/frame.h"
#include "scene/scene.h"
#include "scene/view_settings.h"

#include <optional>
#include <span>

namespace blush {

// Paths that a picture has to hold before metering it says anything: enough for the mean of each of its cells.
constexpr int64_t paths_to_meter = 1 << 16;

// Stops for `view`, whose own exposure is left out. The subject is the selected nodes with all below them, where they take up enough of the
// picture; else what is in focus, where the lens has an aperture; else all objects. The backdrop is never part of it. The log-average
// luminance of the subject becomes middle grey (exposure_meter.h), lower where more than a few per cent of it would be clipped by the view
// transform, or, by at most 1.5 stops, of the whole picture, or where its mean display luminance would be above 0.55. Means of cells stand for pixels, so that noise does not count as highlights.
// Nothing where the subject is black or there is no object.
std::optional<float> subject_exposure(const Frame& frame, const Scene& scene, std::span<const Id<Node>> selected, const ViewSettings& view,
                                      const ColorManagement& color);

} // namespace blush
