// Meters the exposure once when a scene was opened, and when a sky or an environment image was chosen.
#pragma once

#include "color/color_management.h"
#include "render/frame.h"
#include "scene/document.h"
#include "ui/ui_state.h"

#include <optional>

namespace blush {

class MeteringOnce {
public:
    // The picture of the document as it is now is to be metered. `opening`: it belongs to opening the file rather than to the last edit.
    void want(const Project& project, bool opening);
    // A file was opened, with this project; nothing of what was wanted before is.
    void opened(bool exposure_is_set, const Project& project) {
        due_.reset();
        if (!exposure_is_set) want(project, true);
    }
    // Meters as soon as the frame, a picture of the document as it is, holds enough samples. Not if the user has set an exposure, or taken the
    // environment back, in the meantime.
    void look(Document& document, const FramePtr& frame, const UiState& ui, const ColorManagement& color);

private:
    struct Due {
        bool opening = false;
        float exposure_ev = 0;
        Environment environment;
    };
    std::optional<Due> due_;
};

} // namespace blush
