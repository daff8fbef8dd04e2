// What pilots learn about sampling lights and directions: visibility of lights, portals, path guiding, light paths, manifold sampling; and
// about what becomes of paths: path reuse and Russian roulette.
#pragma once

#include "core/parallel.h"
#include "render/compile/feature_report.h"
#include "render/kernels/kernel.h"
#include "render/pilots/caustic_options.h"
#include "render/pilots/guiding_choice.h"
#include "render/pilots/kept_field.h"
#include "render/pilots/light_path_choice.h"
#include "render/pilots/manifold_choice.h"
#include "render/pilots/portal_choice.h"
#include "render/pilots/reuse_choice.h"
#include "render/pilots/visibility_choice.h"
#include "render/roulette/adjoint_choice.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

class LearnedSampling {
public:
    LearnedSampling() = default;
    // For a new image of a compiled scene. `film`: its planes.
    LearnedSampling(const RenderSettings& settings, const RenderScene& scene, const FilmSize& film, const CausticOptions& options = {});

    // Takes over what does not depend on the camera. `before`: for an image that differs at most in the view.
    void keep_from(const LearnedSampling& before) { photons_ = before.photons_; }
    // Takes over what the first sample begins with: the field of path guiding, or the seeds of manifold sampling. `before`: of the image
    // before the edit; `origin`: of the scene after it.
    void keep_learned(LearnedSampling before, const FieldEffect& effect, const Vec3d& origin);
    // The field that an edit left over; null: none, or the pilots have run.
    const KeptField* kept_field() const { return kept_ && guiding_.needs_pilot() ? &*kept_ : nullptr; }

    // The seeds that an edit left over; null: none, or the pilots have run.
    const ManifoldSeedTable* kept_seeds() const { return kept_seeds_ && manifolds_.needs_pilot() ? &kept_seeds_->table : nullptr; }

    // True if a pilot must run before samples of an index below this one.
    bool needs_pilot(int64_t samples) const {
        return (samples > 1 && (visibility_.needs_pilot() || portals_.needs_pilot() || guiding_.needs_pilot() ||
                                light_paths_.needs_pilot() || manifolds_.needs_pilot() || (reuse_.needs_pilot() && !excludes_reuse()))) ||
               (samples > first_roulette_sample() && adjoint_.needs_pilot());
    }
    // Runs the pilots that samples of an index below `samples` need; each measures the samples as those before it have decided. `context`:
    // as for the film at full resolution, except its seed and groups; its scene has learned nothing. `scratch`: one per worker, allocated
    // if needed. False if `wanted` returned false.
    bool decide(int64_t samples, KernelContext context, const Kernel& kernel, const Workers& workers,
                std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted);

    // True if other samples than the first are rendered in another way.
    bool pays() const {
        return visibility_.pays() || portals_.pays() || guiding_.pays() || light_paths_.pays() || manifolds_.pays() || adjoint_.pays();
    }
    // True if the noise of a first sample without would be more than twice that of the others: below, discarding it would lose more than
    // its noise takes from the mean. Always where light paths share light with the camera's samples, which have none of it there.
    bool renews_first() const {
        return visibility_.gains_much() || portals_.gains_much() || guiding_.gains_much() || light_paths_.combined() ||
               manifolds_.gains_much();
    }
    // The tables for a sample of this index at full resolution. Requires !needs_pilot(sample + 1). Valid as long as this object and
    // the scene.
    SceneTables tables(const SceneTables& scene, int64_t sample) const {
        const SceneTables t = guiding_.tables(portals_.tables(visibility_.tables(scene, sample), sample), sample);
        return adjoint_.tables(manifolds_.tables(light_paths_.tables(t, sample), sample), sample);
    }
    // The same for light paths, if light_paths().pays().
    LightPathPass light_path_pass(const SceneTables& scene) const { return light_paths_.pass(tables(scene, 1)); }
    // Images begin without them from now on.
    void drop_kept() {
        kept_.reset();
        kept_seeds_.reset();
    }
    // True if there is a field, or are seeds, that the next image may begin with.
    bool has_kept() const { return kept_ || kept_seeds_ || guiding_.pays() || manifolds_.pays(); }
    // The tables for samples before the pilots have run, if kept_field() or kept_seeds().
    SceneTables kept_tables(SceneTables scene) const {
        if (kept_seeds()) return manifolds_.kept_tables(scene, kept_seeds_->table);
        scene.guides.learned = kept_->tables();
        return scene;
    }
    const LightPathChoice& light_paths() const { return light_paths_; }
    // LightPathChoice::early(); empty where kept seeds find this light.
    std::optional<LightPathPass> early_light_paths(const SceneTables& scene, int64_t pixels) {
        return kept_seeds() ? std::nullopt : light_paths_.early(scene, scene_sphere_, pixels);
    }
    bool uses_manifolds() const { return manifolds_.pays(); }
    // True if samples are connected to other vertices than path reuse knows, by densities that it does not know.
    bool excludes_reuse() const { return light_paths_.combined() || manifolds_.pays(); }
    // True if a sample of this index may go on in several copies (path_splitting.h). Requires !needs_pilot(sample + 1).
    bool splits(int64_t sample) const {
        return sample >= AdjointChoice::first_sample && adjoint_.splits() && !excludes_reuse() && reuse_group_size(sample) == 1;
    }
    const ReuseChoice& reuse() const { return reuse_; }
    // The decision of its pilot, as saved with samples.
    void decide_reuse(const PilotFigures& pilot) { reuse_.decide(pilot); }
    // Pixels in a group of path reuse for a sample of this index at full resolution; 1: none.
    int reuse_group_size(int64_t sample) const { return sample > 0 && excludes_reuse() ? 1 : reuse_.group_size(sample); }

    // `kept`: samples are rendered with kept_tables().
    FeatureReport report(bool kept = false) const {
        return {visibility_.report(),
                portals_.report(),
                guiding_.report(kept ? kept_field() : nullptr),
                light_paths_.report(),
                manifolds_.report(kept ? kept_seeds() : nullptr),
                manifolds_.vertex_report(),
                manifolds_.sharing_report(),
                reuse_.report(excludes_reuse()),
                adjoint_.report()};
    }

private:
    // The first sample that must know how roulette acts: where manifold sampling pays, it only starts later.
    int64_t first_roulette_sample() const { return manifolds_.pays() ? 1 : AdjointChoice::first_sample; }

    VisibilityChoice visibility_;
    PortalChoice portals_;
    GuidingChoice guiding_;
    LightPathChoice light_paths_;
    ManifoldChoice manifolds_;
    ReuseChoice reuse_;
    AdjointChoice adjoint_;
    CasterSphere scene_sphere_{};
    std::optional<int> refined_chain_; // delta lobes before the emission that smooth edges refine; empty: there are none
    Vec3d origin_{0, 0, 0};
    std::optional<KeptField> kept_;
    struct KeptSeeds {
        ManifoldSeedTable table;
        double share; // FieldEffect::factor since they were made
    };
    std::optional<KeptSeeds> kept_seeds_;
    std::shared_ptr<const CausticPhotons> photons_; // as traced without learned visibility, which depends on the camera; may be null
};

} // namespace blush
