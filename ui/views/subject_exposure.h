// Auto exposure for the subject of an image.
#pragma once

#include "color/color_management.h"
#include "render/frame.h"
#include "scene/scene.h"
#include "scene/view_settings.h"

#include <optional>
#include <span>

namespace blush {

// Minimum paths of an image for metering: enough for the mean of each cell.
constexpr int64_t paths_to_meter = 1 << 16;

// Stops for `view`, whose own exposure is ignored. The subject is: the selected nodes with their children, if large enough in the
// image; else the objects in focus, if the lens has an aperture; else all objects. The background is never part of it. The
// log-average luminance of the subject becomes middle grey (exposure_meter.h). The exposure is lower if the view transform would
// clip more than a few per cent of the subject or, by at most 1.5 stops, of the whole image, or if the image's mean display
// luminance would exceed 0.55. Cells are averaged, so that noise does not count as highlights. nullopt if the subject is black or
// there is no object.
std::optional<float> subject_exposure(const Frame& frame, const Scene& scene, std::span<const Id<Node>> selected, const ViewSettings& view,
                                      const ColorManagement& color);

} // namespace blush
