#include "render/pilots/edges/edge_choice.h"

#include "render/compile/render_scene.h"

#include <fmt/format.h>

namespace blush {
namespace {

// Why smooth edges cannot gain anything or do not fit the image; null if they may.
const char* why_useless(const RenderSettings& settings, const RenderScene& scene, bool transparent) {
    if (!settings.smooth_edges) return "switched off";
    if (!scene.camera_sees_emission() && !scene.may_have_highlights()) return "the camera sees no light source";
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
    : useless_(why_useless(settings, scene, transparent)) {
    // The clamped mean of a highlight is not the mean of clamped samples, and copies of a split path are no sample that could be repeated.
    if (scene.may_have_highlights() && !(settings.clamp.limit > 0) && settings.roulette.rule != Roulette::Rule::splitting)
        longest_chain_ = longest_highlight_chain;
}

FeatureUse EdgeChoice::report() const {
    FeatureUse use{.part = "film", .name = "smooth edges", .used = !useless_ && !(pixels_ && pixels_->empty()), .why = {}};
    if (useless_)
        use.why = useless_;
    else if (!pixels_)
        use.why = "a pilot finds the pixels after the first sample";
    else if (pixels_->empty())
        use.why = "pilot: edges and highlights of visible light sources have too small a share of the noise";
    else {
        std::string pixels;
        const auto add = [&](const char* where, int samples, const char* rays) {
            if (const int64_t count = pixels_->count(samples); count > 0)
                pixels += fmt::format("{}{} pixels {}, {} {} a sample", pixels.empty() ? "" : "; ", count, where, samples, rays);
        };
        add("at edges of visible light sources", edge_samples, "camera rays");
        add("with highlights of lamps in smooth surfaces", highlight_samples, "paths");
        add("with bright highlights", bright_highlight_samples, "paths");
        add("with faint images of lamps", faint_highlight_samples, "path by all lobes");
        use.why = "pilot: " + pixels;
    }
    return use;
}

} // namespace blush
