#include "app/editor/live_mix.h"

namespace blush {

void LiveMix::follow(const FramePtr& frame, const Document& document) {
    const auto groups = frame ? frame->light_groups : nullptr;
    if (groups == groups_ && document.revision() == revision_) return;
    groups_ = groups;
    revision_ = document.revision();
    // Compares again: the displayed image follows an edit before it is submitted.
    mixing_ = groups ? compared_mixing(*groups, document.project().scene) : std::nullopt;
}

} // namespace blush
