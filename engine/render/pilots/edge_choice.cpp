#include "render/pilots/edge_choice.h"

#include "render/compile/render_scene.h"
#include "render/film/edge_samples.h"

#include <fmt/format.h>

namespace blush {
namespace {

// Why smooth edges cannot gain anything or do not fit the image; null if they may.
const char* why_useless(const RenderSettings& settings, const RenderScene& scene, bool transparent) {
    if (!settings.smooth_edges) return "switched off";
    if (!scene.camera_sees_emission()) return "the camera sees no light source";
    if (settings.max_bounces == 0) return "paths end at their first hit";
    // Coverage, and what is behind a shadow catcher, belong to the sample's own camera ray.
    if (transparent) return "the background is transparent";
    if (!scene.catchers().empty()) return "there is a shadow catcher";
    // The clamped mean of an edge is not the mean of clamped samples.
    if (settings.clamp.limit > 0 && settings.clamp.all) return "all light is clamped";
    return nullptr;
}

} // namespace

EdgeChoice::EdgeChoice(const RenderSettings& settings, const RenderScene& scene, bool transparent)
    : useless_(why_useless(settings, scene, transparent)) {}

FeatureUse EdgeChoice::report() const {
    FeatureUse use{.part = "film", .name = "smooth edges", .used = !useless_ && !(pixels_ && pixels_->count() == 0), .why = {}};
    if (useless_)
        use.why = useless_;
    else if (!pixels_)
        use.why = "a pilot finds the pixels after the first sample";
    else if (pixels_->count() == 0)
        use.why = "pilot: the edges of visible light sources have too small a share of the noise";
    else
        use.why =
            fmt::format("pilot: {} pixels at edges of visible light sources, {} camera rays a sample", pixels_->count(), edge_samples);
    return use;
}

} // namespace blush
