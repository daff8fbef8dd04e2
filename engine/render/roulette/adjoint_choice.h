// Which samples of an image are rendered with the learned adjoint, or with a later start of Russian roulette.
#pragma once

#include "render/compile/feature_report.h"
#include "render/compile/scene_tables.h"
#include "render/roulette/adjoint_pilot.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace blush {

// The first four samples of each pixel and all samples of coarse images are rendered without, so that no edit waits for a pilot
// (adjoint_pilot.h), which takes as long as half a sample. Every sample is unbiased, and a sample is the same in any range in which it is
// rendered. Rules that read the throughput alone need no pilot.
class AdjointChoice {
public:
    AdjointChoice() = default;
    // For a new image.
    explicit AdjointChoice(const RenderSettings& settings);

    // The first sample that follows the pilot. Later samples may take twice as long: in the first seconds after an edit more samples are
    // worth more than better ones, and the denoiser waits for the fourth (`blush_bench quality`).
    static constexpr int64_t first_sample = 4;
    // True if the pilot must run before sample first_sample.
    bool needs_pilot() const { return !useless_ && !learned_; }
    void decide(AdjointPilot learned) { learned_ = std::move(learned); }

    // True if samples from first_sample on follow a learned rule, or all but the first start roulette later than the settings.
    bool pays() const { return learned_ && (!learned_->field.empty() || learned_->start > 0); }
    // True if samples from first_sample on may go on in several copies. What replays a sample follows one of them (path_recorder.h).
    bool splits() const { return learned_ && learned_->field.splits(); }
    // The scene's tables for a sample of this index at full resolution. Requires the pilot from first_sample on. Valid as long as both.
    SceneTables tables(const SceneTables& scene, int64_t sample) const;

    FeatureUse report() const;

private:
    const char* useless_ = "nothing is rendered"; // null: the pilot must run
    int width_ = 0, height_ = 0;
    std::optional<AdjointPilot> learned_;
};

} // namespace blush
