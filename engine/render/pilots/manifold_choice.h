// Whether an image is rendered with manifold sampling, as its pilot decides.
#pragma once

#include "render/compile/feature_report.h"
#include "render/compile/scene_tables.h"
#include "render/film/film_size.h"
#include "render/pilots/caustic_options.h"
#include "render/pilots/manifold_pilot.h"
#include "scene/render_settings.h"

#include <optional>
#include <utility>

namespace blush {

class RenderScene;

// As with path guiding (guiding_choice.h), which it replaces where it pays. With light paths, it leaves the caustics that the camera sees
// directly to them. Only scenes with casters of caustics get a pilot (manifold_pilot.h).
class ManifoldChoice {
public:
    ManifoldChoice() = default;
    // For a new image of a compiled scene. `film`: its planes. `options`: override the pilot (RendererOptions).
    ManifoldChoice(const RenderSettings& settings, const RenderScene& scene, const FilmSize& film, const CausticOptions& options);

    // True if a pilot must decide before any sample but the first.
    bool needs_pilot() const { return !useless_ && !pilot_; }
    // Takes its result; ignored if nothing depends on it.
    void decide(ManifoldPilot pilot);

    bool pays() const {
        if (!pilot_ || pilot_->seeds.empty()) return false;
        return used_ ? *used_ : pilot_->figures && !pilot_->endless && pays_by(*pilot_->figures);
    }
    // True if samples are connected to light vertices.
    bool uses_light_vertices() const {
        if (!pays() || !pilot_->vertex_figures) return false;
        return uses_vertices_ ? *uses_vertices_ : pilot_->vertex_figures->cost() < largest_vertex_cost;
    }
    // True if chains are shared with light paths.
    bool shares_chains() const { return pays() && pilot_->shares; }
    // Overrides the pilot about it.
    std::optional<bool> forced_sharing() const { return shares_; }
    // True if a solid of the scene has dispersion: then there are no light vertices.
    bool disperses() const { return disperses_; }
    bool gains_much() const { return pays() && (used_ || pilot_->figures->cost() < 0.5); }
    // The tables for a sample of this index at full resolution. Requires a decision except for index 0. Valid as long as both.
    SceneTables tables(SceneTables scene, int64_t sample) const;

    // The seeds of an image whose pilot has found that they pay; this object must not be used any more.
    ManifoldSeedTable take_seeds() { return std::move(pilot_->seeds); }
    // The tables for samples before the pilot has run, with the seeds of before an edit. Valid as long as these.
    SceneTables kept_tables(SceneTables scene, const ManifoldSeedTable& seeds) const {
        scene.manifolds = seeds.tables(casters_);
        scene.guides = {};
        return scene;
    }

    // `kept`: samples are rendered with kept_tables().
    FeatureUse report(const ManifoldSeedTable* kept = nullptr) const;
    FeatureUse vertex_report() const;
    FeatureUse sharing_report() const;

private:
    static constexpr double largest_cost = 0.75; // a pilot errs, walks take more time than their rays, and the kernel is slower
    // Of a typical tile: elsewhere most of the variance without is that of paths so rare that no image of usual length has any.
    static constexpr double largest_typical_cost = 0.9;

    static constexpr double largest_vertex_cost = 0.9;

    static bool pays_by(const PilotFigures& figures) {
        return figures.cost() < largest_cost && figures.typical * figures.work < largest_typical_cost;
    }

    const char* useless_ = "nothing is rendered"; // null: a pilot decides
    std::optional<bool> used_, uses_vertices_, shares_;
    bool disperses_ = false;
    CausticCasterTables casters_;
    std::optional<ManifoldPilot> pilot_;
};

} // namespace blush
