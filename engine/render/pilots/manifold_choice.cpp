#include "render/pilots/manifold_choice.h"

#include "render/compile/render_scene.h"
#include "render/pilots/caustic_limits.h"

#include <fmt/format.h>
#include <utility>

namespace blush {

namespace {

const char* why_no_manifolds(const RenderSettings& settings, const RenderScene& scene, const FilmSize& film) {
    if (const char* why = why_excluded(settings, CausticStrategy::manifold)) return why;
    if (const char* limit = why_no_caustics(settings, scene, film)) return limit;
    return scene.tables().casters.count == 0 ? "no mirror or solid glass has light to focus" : nullptr;
}

} // namespace

ManifoldChoice::ManifoldChoice(const RenderSettings& settings, const RenderScene& scene, const FilmSize& film,
                               const CausticOptions& options)
    : useless_(why_no_manifolds(settings, scene, film)), used_(options.manifold_sampling), uses_vertices_(options.light_vertices),
      shares_(options.shared_chains), disperses_(scene.features().has(Feature::dispersion)), casters_(scene.tables().casters) {}

void ManifoldChoice::decide(ManifoldPilot pilot) {
    if (!useless_) pilot_ = std::move(pilot);
}

SceneTables ManifoldChoice::tables(SceneTables scene, int64_t sample) const {
    if (sample == 0 || !pays()) return scene;
    scene.manifolds = pilot_->seeds.tables(casters_);
    scene.manifolds.shares = shares_chains();
    if (uses_light_vertices()) scene.light_vertices = pilot_->light_vertices();
    scene.guides = {};
    return scene;
}

FeatureUse ManifoldChoice::report(const ManifoldSeedTable* kept) const {
    FeatureUse use{.part = "kernel", .name = "manifold sampling", .used = pays(), .why = {}};
    if (kept) {
        use.used = true;
        use.why = "the first sample begins with the seeds of before the edit";
        use.bytes = int64_t(kept->memory_bytes());
        return use;
    }
    if (useless_)
        use.why = useless_;
    else if (!pilot_)
        use.why = "a pilot decides after the first sample";
    else if (!pilot_->figures)
        use.why = "pilot: no light reaches the image by mirrors and smooth glass alone";
    else if (pilot_->endless)
        use.why = "pilot: some ways of light are found too rarely";
    else
        use.why = fmt::format("pilot: variance x work {} {:.2f} of that without, of a typical tile {:.2f}", use.used ? "is" : "would be",
                              pilot_->figures->cost(), pilot_->figures->typical * pilot_->figures->work);
    if (use.used) use.bytes = int64_t(pilot_->seeds.memory_bytes());
    if (pilot_) use.pilot = pilot_->figures;
    return use;
}

FeatureUse ManifoldChoice::vertex_report() const {
    FeatureUse use{.part = "kernel", .name = "light vertices", .used = uses_light_vertices(), .why = {}};
    if (!pays())
        use.why = "manifold sampling is not used";
    else if (pilot_->emission.empty())
        use.why = "a pane transmits light straight through, a surface is blended, or a solid has dispersion";
    else if (pilot_->usual_ratio == 0)
        use.why = "pilot: no light path has reached a diffuse surface by mirrors and smooth glass alone";
    else
        use.why = fmt::format("pilot: variance x work {} {:.2f} of that of manifold sampling alone", use.used ? "is" : "would be",
                              pilot_->vertex_figures->cost());
    if (use.used) use.bytes = int64_t(pilot_->emission.memory_bytes());
    if (pilot_ && pilot_->vertex_figures) use.pilot = pilot_->vertex_figures;
    return use;
}

FeatureUse ManifoldChoice::sharing_report() const {
    FeatureUse use{.part = "kernel", .name = "shared chains", .used = shares_chains(), .why = {}};
    if (!pays())
        use.why = "manifold sampling is not used";
    else if (!pilot_->shared_figures)
        use.why = "there are no light paths";
    else
        use.why = fmt::format("pilot: variance x work {} {:.2f} of that of manifold sampling and light paths apart",
                              use.used ? "is" : "would be", pilot_->shared_figures->cost());
    if (pilot_) use.pilot = pilot_->shared_figures;
    return use;
}

} // namespace blush
