// Which samples of an image are rendered with learned visibility, as its pilot decides.
#pragma once

#include "render/compile/feature_report.h"
#include "render/compile/scene_tables.h"
#include "render/lights/light_visibility.h"
#include "scene/render_settings.h"

#include <cstdint>
#include <optional>

namespace blush {

class RenderScene;

// The first sample of each pixel and all samples of coarse images are rendered without learned visibility, so that no edit waits for a
// pilot (but see LearnedSampling::renews_first). The pilot (visibility_pilot.h) decides about the other samples. It depends on the scene
// and the settings alone, not on the image's samples: so every sample is unbiased, and a sample is the same in any range in which it is
// rendered. A scene without several lights, or in which all lights are equally visible, gets none.
class VisibilityChoice {
public:
    VisibilityChoice() = default;
    // For a new image of a compiled scene.
    VisibilityChoice(const RenderSettings& settings, const RenderScene& scene);

    // True if a pilot must decide before any sample but the first.
    bool needs_pilot() const { return !useless_ && !learned_; }
    // Takes its result; ignored if nothing depends on it.
    void decide(LightVisibility learned);

    // True if samples after the first select lights by learned visibility.
    bool pays() const { return learned_ && learned_->second_moment() <= largest_second_moment && learned_->grid().factors; }
    bool gains_much() const { return pays() && learned_->second_moment() < 0.5; }
    // The scene's tables for a sample of this index at full resolution. Requires a decision except for index 0. Valid as long as both.
    SceneTables tables(const SceneTables& scene, int64_t sample) const;

    FeatureUse report() const;

private:
    // Reading the factors takes 2 to 4 % of the rendering time, and light selection is not all of the noise.
    static constexpr double largest_second_moment = 0.9;

    const char* useless_ = "nothing is rendered"; // null: a pilot decides
    std::optional<LightVisibility> learned_;
};

} // namespace blush
