// The mix of the lights that a frame keeps apart, as the project has it by now: the picture follows it at once where gains are all it takes,
// whatever the session is at.
#pragma once

#include "render/frame.h"
#include "render/light_groups.h"
#include "scene/document.h"

#include <memory>
#include <optional>

namespace blush {

class FollowedMix {
public:
    // `frame` may be null.
    void follow(const FramePtr& frame, const Document& document);
    // Null where there are no groups, or no gains would do.
    const Mixing* mixing() const { return mixing_ ? &*mixing_ : nullptr; }
    // Is this frame, shown with these gains, the picture of that mix?
    bool is_shown_by(const Frame& frame, const Gains& gains) const {
        return mixing_ && frame.light_groups == groups_ && gains == mixing_->gains;
    }

private:
    std::optional<Mixing> mixing_;
    std::shared_ptr<const LightGroups> groups_; // of which it is,
    uint64_t revision_ = 0;                     // and of which of the document
};

} // namespace blush
