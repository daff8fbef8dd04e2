#include "render/pilots/light_path_choice.h"

#include "render/compile/render_scene.h"
#include "render/pilots/caustic_limits.h"

#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

const char* why_no_light_paths(const RenderSettings& settings, const RenderScene& scene, const FilmSize& film) {
    if (const char* why = why_excluded(settings, CausticStrategy::light_paths)) return why;
    if (const char* why = why_no_caustics(settings, scene, film)) return why;
    // Splats are not samples, so they cannot be clamped as such.
    return settings.clamp.limit > 0 ? "samples are clamped" : nullptr;
}

} // namespace

LightPathChoice::LightPathChoice(const RenderSettings& settings, const RenderScene& scene, const FilmSize& film, std::optional<float> share)
    : useless_(why_no_light_paths(settings, scene, film)), share_(share), pixels_(double(settings.width) * double(settings.height)),
      smooth_(scene.may_have_highlights()), misses_light_(!scene.missing_light(CausticFinders::none).empty()) {}

std::optional<LightPathPass> LightPathChoice::early(const SceneTables& scene, const CasterSphere& scene_sphere, int64_t pixels) {
    if (useless_ || share_ || !misses_light_) return std::nullopt;
    if (!early_) early_ = LightPathEmission::of_zero_size_lights(scene, scene_sphere);
    if (early_->empty()) return std::nullopt;
    LightPathPass pass{&*early_, scene, pixels};
    pass.tables.emission = early_->tables(float(pixels));
    return pass;
}

void LightPathChoice::decide(LightPathPilot pilot) {
    if (useless_) return;
    pilot_ = std::move(pilot);
    if (share_ && (pilot_->figures || !pilot_->zero_size.empty())) pilot_->share = *share_;
}

float LightPathChoice::share() const {
    if (!pays()) return 0;
    if (share_) return *share_;
    const float by_figures = pays_by_figures() ? pilot_->share : 0;
    return std::max(by_figures, pilot_->zero_size_share);
}

double LightPathChoice::work_per_sample() const {
    if (!pays()) return 0;
    // Of both kinds at most.
    const double of_path = combined() ? std::max(pilot_->work, pilot_->zero_size_work) : pilot_->zero_size_work;
    return double(share()) * of_path;
}

SceneTables LightPathChoice::tables(SceneTables scene, int64_t sample) const {
    return sample > 0 && combined() ? pass(scene).tables : scene;
}

LightPathPass LightPathChoice::pass(SceneTables scene) const {
    scene.emission = emission().tables(float(paths()));
    return {&emission(), scene, paths()};
}

FeatureUse LightPathChoice::report() const {
    FeatureUse use{.part = "kernel", .name = "light paths", .used = pays(), .why = {}};
    const bool before_pilot = !pilot_ && early_ && !early_->empty();
    if (useless_)
        use.why = useless_;
    else if (before_pilot)
        use.why = "before the pilot, they alone find caustics of lights of zero size, with 1 for each camera path";
    else if (!pilot_)
        use.why = "a pilot decides after the first sample";
    else if (pays() && !pays_by_figures() && !share_)
        use.why = fmt::format("they alone find caustics of lights of zero size, with {} for each camera path", share());
    else if (!pilot_->figures)
        use.why = "pilot: no light path reaches the image";
    else if (pilot_->share > 0)
        use.why =
            fmt::format("pilot: variance x work is {:.2f} of that without, with {} for each camera path", pilot_->figures->cost(), share());
    else
        use.why = fmt::format("pilot: variance x work would be {:.2f} of that without", pilot_->figures->cost());
    if (use.used) use.bytes = emission().memory_bytes();
    if (before_pilot) {
        use.used = true;
        use.bytes = early_->memory_bytes();
    }
    if (pilot_) use.pilot = pilot_->figures;
    return use;
}

} // namespace blush
