#include "render/session/view_history_keeper.h"

#include "render/session/first_hit_sharing.h"

namespace blush {
namespace {

// What the denoised image shows, at its size.
FirstHitPlanesPtr seen_by(const FramePtr& frame) { return frame->first_hits ? frame->first_hits : first_hits_of(frame, *frame->camera); }

} // namespace

void ViewHistoryKeeper::follow(const FramePtr& frame, DenoisedImage& denoised, const Workers* workers) {
    if (frame->look != look_ || !frame->camera || !frame->groups.empty()) forget();
    if (!frame->camera || !frame->groups.empty()) return;
    look_ = frame->look;
    const FirstHitPlanesPtr seen = seen_by(frame);
    if (seen->depth.empty() || seen->albedo.empty() || seen->normal.empty()) return;
    const bool is_coarse = frame->divider > 1, begins = !frame->complete && frame->samples < most_samples;
    if ((is_coarse || begins) && !history_.empty() && frame->camera != history_.camera)
        denoised.with_history = with_history(denoised.denoised.rgb, is_coarse, *seen, history_, workers);
    if (is_coarse) return;
    history_ = seen->depth.size() <= most_pixels_ ? ViewHistory(*seen, denoised.denoised.rgb) : ViewHistory();
}

} // namespace blush
