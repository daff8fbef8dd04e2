// Gives coarse frames the first hits by which their denoised images are enlarged (joint_upsampling.h).
#pragma once

#include "render/frame.h"
#include "render/renderer.h"

#include <memory>

namespace blush {

// The frame's planes of albedo, normal and depth as first hits, which keep it in memory.
FirstHitPlanesPtr first_hits_of(const FramePtr& frame, const WorldCamera& camera);

class FirstHitSharing {
public:
    // True if coarse frames of the renderer's scene get known first hits, unless they show a region.
    static bool knows(const Renderer& renderer) { return renderer.has_sharp_first_hits() && renderer.first_hits(); }
    // A coarse frame gets the first hits of the renderer's scene: known ones, or traced here, for the first image of an edit only if that
    // is fast. None for a region, or where first hits are not sharp. A frame of full size has them: the renderer keeps them for the next
    // edits.
    void share(Renderer& renderer, const std::shared_ptr<Frame>& frame, bool has_first_image);

private:
    FirstHitPlanesPtr first_hits_for(const Frame& frame, Renderer& renderer, bool has_first_image);

    double seconds_per_pixel_ = 1e-7; // of tracing; measured, from the first time on
};

} // namespace blush
