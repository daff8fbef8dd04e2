#include "render/session/view_history_keeper.h"

namespace blush {
namespace {

// What the denoised image shows, at its size.
FirstHitPlanesPtr seen_by(const FramePtr& frame) {
    if (frame->first_hits) return frame->first_hits;
    return std::make_shared<const FirstHitPlanes>(
        FirstHitPlanes{frame->width, frame->height, frame->albedo, frame->normal, frame->depth, frame, *frame->camera});
}

} // namespace

void ViewHistoryKeeper::follow(const FramePtr& frame, DenoisedImage& denoised, const Workers* workers) {
    if (frame->look != look_ || !frame->camera || !frame->groups.empty()) forget();
    if (!frame->camera || !frame->groups.empty()) return;
    look_ = frame->look;
    const FirstHitPlanesPtr seen = seen_by(frame);
    if (seen->depth.empty() || seen->albedo.empty() || seen->normal.empty()) return;
    if (frame->divider == 1)
        history_ = ViewHistory(*seen, denoised.denoised.rgb);
    else if (!history_.empty() && frame->camera != history_.camera)
        denoised.with_history = with_history(denoised.denoised.rgb, *seen, history_, workers);
}

} // namespace blush
