// Meters the exposure once after a scene was opened, and after a sky or an environment image was chosen.
#pragma once

#include "color/color_management.h"
#include "render/frame.h"
#include "scene/document/document.h"
#include "ui/window/ui_state.h"

#include <optional>

namespace blush {

class OneShotMetering {
public:
    // Requests metering for the current document. `opening`: as part of opening the file rather than of the last edit.
    void want(const Project& project, bool opening);
    // A file with this project was opened; drops pending requests.
    void opened(bool exposure_is_set, const Project& project) {
        due_.reset();
        if (!exposure_is_set) want(project, true);
    }
    // Meters as soon as the frame shows the current document with enough samples. Not if the user has set an exposure, or undone
    // the environment, in the meantime.
    void update(Document& document, const FramePtr& frame, const UiState& ui, const ColorManagement& color);

private:
    struct Due {
        bool opening = false;
        float exposure_ev = 0;
        Environment environment;
    };
    std::optional<Due> due_;
};

} // namespace blush
