// Which pixels of an image have smooth edges: more samples of the emission that the camera sees (edge_samples.h).
#pragma once

#include "render/compile/feature_report.h"
#include "render/film/edges/edge_pixels.h"
#include "scene/render_settings.h"

#include <cstdint>
#include <optional>

namespace blush {

class RenderScene;

// The first sample of each pixel and all samples of coarse images are rendered without, so that no edit waits for the pilot
// (edge_pilot.h) that finds the pixels; the first sample gets them when another one follows. It depends on the scene and the settings
// alone, so another render of them finds the same pixels. A scene whose camera sees no emission, directly or in smooth surfaces, gets no
// pilot.
class EdgeChoice {
public:
    EdgeChoice() = default;
    // For a new image of a compiled scene. `transparent`: the image has a transparent background.
    EdgeChoice(const RenderSettings& settings, const RenderScene& scene, bool transparent);

    // True if a pilot must find the pixels before any sample but the first.
    bool needs_pilot() const { return !useless_ && !pixels_; }
    void decide(EdgePixels pixels) { pixels_ = std::move(pixels); }
    // For a sample of this index, at full resolution; null: none. Requires a decision except for index 0.
    const EdgePixels* pixels(int64_t sample) const { return sample > 0 && pixels_ && !pixels_->empty() ? &*pixels_ : nullptr; }
    // Delta lobes between camera and emission; 0 where highlights are left as they are.
    int longest_chain() const { return longest_chain_; }

    FeatureUse report() const;

private:
    const char* useless_ = "nothing is rendered"; // why nothing can be gained; null: something may
    int longest_chain_ = 0;
    std::optional<EdgePixels> pixels_;
};

} // namespace blush
