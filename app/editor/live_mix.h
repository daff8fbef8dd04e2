// The current light mix of a frame with light groups: applied to the displayed image at once if gains are sufficient, independent of the
// render session.
#pragma once

#include "render/frame.h"
#include "render/light_mix/light_groups.h"
#include "scene/document/document.h"

#include <memory>
#include <optional>

namespace blush {

class LiveMix {
public:
    // `frame` may be null.
    void follow(const FramePtr& frame, const Document& document);
    // Null if there are no groups, or gains are not sufficient.
    const Mixing* mixing() const { return mixing_ ? &*mixing_ : nullptr; }
    // True if this frame, shown with these gains, is the image of the current mix.
    bool is_shown_by(const Frame& frame, const Gains& gains) const {
        return mixing_ && frame.light_groups == groups_ && gains == mixing_->gains;
    }

private:
    std::optional<Mixing> mixing_;
    std::shared_ptr<const LightGroups> groups_; // the groups,
    uint64_t revision_ = 0;                     // and the document revision it was computed for
};

} // namespace blush
