// Which samples of an image are rendered with path guiding, as its pilot decides.
#pragma once

#include "render/compile/feature_report.h"
#include "render/compile/scene_tables.h"
#include "render/lights/guiding_field.h"
#include "render/pilots/kept_field.h"
#include "scene/render_settings.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace blush {

class RenderScene;

// As with learned portals (portal_choice.h). Only scenes with casters of caustics get a pilot (guiding_pilot.h).
class GuidingChoice {
public:
    GuidingChoice() = default;
    // For a new image of a compiled scene.
    GuidingChoice(const RenderSettings& settings, const RenderScene& scene);

    // True if a pilot must decide before any sample but the first.
    bool needs_pilot() const { return !useless_ && !field_; }
    // Takes its result; ignored if nothing depends on it.
    void decide(GuidingField field);

    bool pays() const { return field_ && field_->figures() && field_->figures()->cost() < largest_cost; }
    bool gains_much() const { return pays() && field_->figures()->cost() < 0.5; }
    // The tables for a sample of this index at full resolution. Requires a decision except for index 0. Valid as long as both.
    SceneTables tables(SceneTables scene, int64_t sample) const;

    // The field, if it pays; requires that nothing is rendered with this any more.
    std::optional<GuidingField> take_field() { return pays() ? std::exchange(field_, std::nullopt) : std::nullopt; }

    // Where manifold sampling pays, it replaces path guiding: frees the field, but keeps the figures of the pilot.
    void leave_to_manifolds();

    // `kept`: the field that is used until the pilot has run; null: none.
    FeatureUse report(const KeptField* kept = nullptr) const;

private:
    static constexpr double largest_cost = 0.75; // of the expected variance, which is not all of the image's

    const char* useless_ = "nothing is rendered"; // null: a pilot decides
    std::optional<GuidingField> field_;
    std::optional<int64_t> released_; // bytes, by leave_to_manifolds()
};

} // namespace blush
