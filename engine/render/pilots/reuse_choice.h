// Which samples of an image are rendered with path reuse: as set, or as a pilot decides.
#pragma once

#include "render/compile/feature_report.h"
#include "scene/render_settings.h"
#include "scene/reuse_setting.h"

#include <array>
#include <cstdint>
#include <optional>

namespace blush {

class RenderScene;

// Pixels in a group that `automatic` path reuse chooses from. The first is that of samples that no pilot has decided over.
constexpr std::array<int, 2> automatic_group_sizes{8, 16};

// Pixels in a group of path reuse, where this is used at all; `pilot`: ReuseChoice::pilot().
int reuse_group_size(const RenderSettings& settings, const std::optional<PilotFigures>& pilot);

// With RenderSettings::reuse automatic, the first sample of each pixel and all samples of coarse images are rendered with path reuse,
// so that no edit waits for a pilot. The pilot (reuse_pilot.h) decides about the other samples, also how many pixels share. It depends on
// the scene and the settings alone, not on the image's samples: so every sample is unbiased, and a sample is the same in any range in which
// it is rendered. A scene without a surface that path reuse needs gets neither path reuse nor a pilot.
class ReuseChoice {
public:
    ReuseChoice() = default;
    // For a new image of a compiled scene.
    ReuseChoice(const RenderSettings& settings, const RenderScene& scene);

    // True if a pilot must decide before any sample but the first.
    bool needs_pilot() const { return automatic_ && !pilot_; }
    // Takes its result; ignored if nothing depends on it.
    void decide(const PilotFigures& pilot);
    const std::optional<PilotFigures>& pilot() const { return pilot_; }

    // Pixels in a group for a sample of this index, at full resolution; 1: no path reuse. Requires a decision except for index 0.
    int group_size(int64_t sample) const;
    // The same for the first sample; without path reuse there, no other sample has any.
    int first_group_size() const { return first_; }

    // `excluded`: all samples but the first have none, as they use strategies whose densities it does not know.
    FeatureUse report(bool excluded = false) const;

private:
    bool pays() const { return !pilot_ || pilot_->cost() < 1; }

    int first_ = 1;
    bool automatic_ = false;        // and path reuse may gain something
    const char* useless_ = nullptr; // why it cannot, if it is automatic
    std::optional<PilotFigures> pilot_;
};

} // namespace blush
