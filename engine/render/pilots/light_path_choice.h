// How many light paths an image gets, as their pilot decides.
#pragma once

#include "render/compile/feature_report.h"
#include "render/compile/scene_tables.h"
#include "render/film/film_size.h"
#include "render/pilots/light_path_pilot.h"
#include "scene/render_settings.h"

#include <cstdint>
#include <optional>

namespace blush {

class RenderScene;

// Light paths for one sample of every pixel.
struct LightPathPass {
    const LightPathEmission* emission;
    SceneTables tables; // that they are traced with
    int64_t paths;
};

// Only scenes with casters of caustics get a pilot (light_path_pilot.h). The decision depends on the scene and the settings alone. All
// samples of an image at full resolution have the same weights, so the first sample is rendered again where light paths are used:
//   - combined with the strategies of the camera's paths by MIS, where that pays, or beside manifold sampling,
//   - else alone, for what these strategies never find: delta lobes that light of zero size has passed. Then the camera's samples are those
//     without light paths. The image must not depend on what a pilot has seen, so this does not, either.
class LightPathChoice {
public:
    LightPathChoice() = default;
    // For a new image of a compiled scene. `film`: its planes. `share`: overrides the pilot's (RendererOptions).
    LightPathChoice(const RenderSettings& settings, const RenderScene& scene, const FilmSize& film, std::optional<float> share);

    // True if a pilot must decide before any sample but the first.
    bool needs_pilot() const { return !useless_ && !pilot_; }
    // False if an image has no light paths, whatever a pilot decides, or it has decided so.
    bool may_be_used() const { return !useless_ && (!pilot_ || pays()); }
    // Takes its result; ignored if nothing depends on it.
    void decide(LightPathPilot pilot);

    // Beside manifold sampling, light paths leave what cameras see by delta lobes to it.
    void combine_with_manifolds(bool manifolds) { with_manifolds_ = manifolds; }

    bool combined() const {
        if (!pilot_) return false;
        return share_ ? pilot_->share > 0 : pays_by_figures() || (with_manifolds_ && !pilot_->zero_size.empty());
    }
    bool alone() const { return pilot_ && !combined() && !share_ && smooth_ && !pilot_->zero_size.empty(); }
    bool pays() const { return combined() || alone(); }
    // For coarse images, and a first sample before the pilot has run: light paths of lights without size, alone, one for each of `pixels`.
    // Empty if such images have none. `scene_sphere` contains all surfaces. Valid as long as this object and the scene.
    std::optional<LightPathPass> early(const SceneTables& scene, const CasterSphere& scene_sphere, int64_t pixels);
    // Light paths for one sample of every pixel of the whole image; 0: none.
    int64_t paths() const { return int64_t(pixels_ * double(share())); }
    // Their rays (path_work) for one sample of a pixel.
    double work_per_sample() const;
    const LightPathEmission& emission() const { return combined() ? pilot_->emission : pilot_->zero_size; }
    // The tables for a sample of the camera's paths of this index at full resolution. Requires a decision except for index 0. Valid as long
    // as both.
    SceneTables tables(SceneTables scene, int64_t sample) const;
    // As the pilot decided, for samples after the first. Requires pays(). Valid as long as this object and the scene.
    LightPathPass pass(SceneTables scene) const;

    FeatureUse report() const;

private:
    static constexpr double largest_cost = 0.9; // a pilot errs by some percent, and the kernel for light paths is slower

    bool pays_by_figures() const { return pilot_->share > 0 && pilot_->figures->cost() < largest_cost; }
    float share() const;

    const char* useless_ = "nothing is rendered"; // null: a pilot decides
    std::optional<float> share_;
    double pixels_ = 0;
    bool smooth_ = false, with_manifolds_ = false;
    bool misses_light_ = false; // without light paths
    std::optional<LightPathEmission> early_;
    std::optional<LightPathPilot> pilot_;
};

} // namespace blush
