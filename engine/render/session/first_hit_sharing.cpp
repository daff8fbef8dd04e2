#include "render/session/first_hit_sharing.h"

#include "render/session/scheduler.h"

#include <chrono>

namespace blush {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double max_seconds_of_first_image = Scheduler::first_image_seconds / 2;

} // namespace

FirstHitPlanesPtr first_hits_of(const FramePtr& frame, const WorldCamera& camera) {
    return std::make_shared<const FirstHitPlanes>(
        FirstHitPlanes{frame->width, frame->height, frame->albedo, frame->normal, frame->depth, frame, camera});
}

FirstHitPlanesPtr FirstHitSharing::first_hits_for(const Frame& frame, Renderer& renderer, bool has_first_image) {
    if (!frame.whole || !renderer.has_sharp_first_hits()) return nullptr;
    if (FirstHitPlanesPtr known = renderer.first_hits()) return known;
    const double pixels = double(frame.width) * double(frame.height) * double(frame.divider) * double(frame.divider);
    if (!has_first_image && pixels * seconds_per_pixel_ > max_seconds_of_first_image) return nullptr;
    const auto begin = Clock::now();
    FirstHitPlanesPtr traced = renderer.trace_first_hits();
    seconds_per_pixel_ = std::chrono::duration<double>(Clock::now() - begin).count() / double(traced->depth.size());
    return traced;
}

void FirstHitSharing::share(Renderer& renderer, const std::shared_ptr<Frame>& frame, bool has_first_image) {
    if (frame->divider > 1)
        frame->first_hits = first_hits_for(*frame, renderer, has_first_image);
    else if (frame->whole)
        renderer.keep_first_hits(first_hits_of(frame, renderer.world_camera()));
}

} // namespace blush
