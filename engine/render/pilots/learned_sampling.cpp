#include "render/pilots/learned_sampling.h"

#include "render/compile/render_scene.h"
#include "render/pilots/edges/edge_choice.h"
#include "render/pilots/guiding_pilot.h"
#include "render/pilots/light_path_pilot.h"
#include "render/pilots/portal_pilot.h"
#include "render/pilots/reuse_pilot.h"
#include "render/pilots/visibility_pilot.h"
#include "render/roulette/adjoint_pilot.h"

#include <optional>
#include <utility>

namespace blush {
namespace {

// Of their use, by the factors of edits: below, walks from the seeds of before take too long.
constexpr double least_share_of_seeds = 0.25;

} // namespace

LearnedSampling::LearnedSampling(const RenderSettings& settings, const RenderScene& scene, const FilmSize& film,
                                 const CausticOptions& options)
    : visibility_(settings, scene), portals_(settings, scene), guiding_(settings, scene),
      light_paths_(settings, scene, film, options.light_path_share), manifolds_(settings, scene, film, options), reuse_(settings, scene),
      adjoint_(settings), scene_sphere_(scene.bounding_sphere()), origin_(scene.origin()) {
    if (const EdgeChoice edges(settings, scene, film.transparent); edges.needs_pilot()) refined_chain_ = edges.longest_chain();
}

void LearnedSampling::keep_learned(LearnedSampling before, const FieldEffect& effect, const Vec3d& origin) {
    const bool decided = !before.needs_pilot(2), with_manifolds = before.manifolds_.pays();
    // Where the first sample was not rendered again, it will probably not be after the edit: it must do without then.
    const bool renewed = decided && before.renews_first();
    if (manifolds_.needs_pilot() && effect.same_chains && origin == before.origin_) {
        if (!decided)
            kept_seeds_ = std::move(before.kept_seeds_);
        else if (renewed && with_manifolds)
            kept_seeds_ = {before.manifolds_.take_seeds(), 1};
        if (kept_seeds_ && (kept_seeds_->share *= effect.factor) < least_share_of_seeds) kept_seeds_.reset();
    }
    if (!guiding_.needs_pilot()) return;
    // Where manifold sampling finds the caustics, the field finds so little of them in one sample that it is noise.
    if (!before.guiding_.needs_pilot()) {
        if (auto field = before.guiding_.take_field(); field && renewed && !with_manifolds)
            kept_.emplace(*std::move(field), before.origin_);
    } else
        kept_ = std::move(before.kept_);
    if (kept_ && !kept_->follow(effect, origin)) kept_.reset();
}

bool LearnedSampling::decide(int64_t samples, KernelContext context, const Kernel& kernel, const Workers& workers,
                             std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    const SceneTables scene = *context.scene;
    const auto run = [&](auto& choice, const auto& pilot) {
        if (!choice.needs_pilot()) return true;
        const SceneTables learned = tables(scene, 1);
        context.scene = &learned;
        auto result = pilot(context, kernel, workers, scratch, wanted);
        if (!result) return false;
        choice.decide(*std::move(result));
        return true;
    };
    std::shared_ptr<const CausticPhotons> traced;
    const auto learn_guiding = [&](const KernelContext& with, auto&&... others) -> std::optional<GuidingField> {
        const bool keeps = !visibility_.pays();
        auto photons = keeps && photons_ ? photons_ : trace_caustic_photons(with, others...);
        if (!photons) return std::nullopt;
        if (keeps) photons_ = photons;
        traced = photons;
        auto field = learn_path_guiding(with, *photons, others...);
        if (field) kept_.reset();
        return field;
    };
    const auto measure_paths = [&](const KernelContext& with, const Kernel& own, auto&&... others) {
        std::optional<RefinedEmission> refined;
        if (refined_chain_) refined.emplace(RefinedEmission{own, *refined_chain_});
        return measure_light_paths(with, scene_sphere_, kernel_like(own, own.features.with(Feature::light_paths)), refined, others...);
    };
    const auto measure_chains = [&](const KernelContext& with, const Kernel& own, auto&&... others) -> std::optional<ManifoldPilot> {
        const Kernel& chains = kernel_like(own, own.features.with(Feature::light_paths));
        if (!traced) traced = trace_caustic_photons(with, own, others...);
        if (!traced) return std::nullopt;
        return measure_manifolds(with, *traced, scene_sphere_, scene.casters, manifolds_.forced_sharing(), manifolds_.disperses(), chains,
                                 light_paths_.combined() ? chains : own, others...);
    };
    const auto learn_roulette = [&](const KernelContext& with, auto&&... others) -> std::optional<AdjointPilot> {
        if (with.settings.roulette.rule == Roulette::Rule::automatic) {
            if (manifolds_.pays()) return roulette_with_manifolds();
            if (light_paths_.combined())
                return AdjointPilot{.why_not = "light paths: a pilot is too short to tell what roulette does to caustics"};
        }
        return learn_adjoint(with, reuse_group_size(1), others...);
    };
    const auto measure_beside_light_paths = [&] {
        if (!manifolds_.needs_pilot()) return true;
        light_paths_.combine_with_manifolds(true);
        if (!run(manifolds_, measure_chains)) return false;
        light_paths_.combine_with_manifolds(manifolds_.pays());
        if (manifolds_.pays()) guiding_.leave_to_manifolds();
        return true;
    };
    return run(visibility_, learn_light_visibility) && run(portals_, learn_portals) && run(guiding_, learn_guiding) &&
           run(light_paths_, measure_paths) && measure_beside_light_paths() && (excludes_reuse() || run(reuse_, measure_path_reuse)) &&
           (samples <= first_roulette_sample() || run(adjoint_, learn_roulette));
}

} // namespace blush
