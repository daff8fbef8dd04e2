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

// Only scenes with casters of caustics get a pilot (light_path_pilot.h). The decision depends on the scene and the settings alone. Where no
// other strategy finds the caustics, as of lights without size, light paths are always used: the image must not depend on the pilot. All
// samples of an image at full resolution have the same weights, so the first sample is rendered again where light paths pay.
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

    bool pays() const { return pilot_ && pilot_->share > 0 && (share_ || are_needed() || pilot_->figures->cost() < largest_cost); }
    // Light paths for one sample of every pixel of the whole image; 0: none.
    int64_t paths() const { return pays() ? int64_t(pixels_ * double(pilot_->share)) : 0; }
    const LightPathEmission& emission() const { return pilot_->emission; }
    // The tables for a sample of this index at full resolution. Requires a decision except for index 0. Valid as long as both.
    SceneTables tables(SceneTables scene, int64_t sample) const;

    FeatureUse report() const;

private:
    bool are_needed() const { return pilot_->emission.has_zero_size_lights(); }

    static constexpr double largest_cost = 0.9; // a pilot errs by some percent, and the kernel for light paths is slower

    const char* useless_ = "nothing is rendered"; // null: a pilot decides
    std::optional<float> share_;
    double pixels_ = 0;
    std::optional<LightPathPilot> pilot_;
};

} // namespace blush
