// Messages about the render: new warnings about the scene, and failures of the session.
#pragma once

#include "render/frame.h"
#include "render/session/render_session.h"
#include "scene/scene.h"
#include "ui/window/ui_state.h"

#include <memory>
#include <string>
#include <vector>

namespace blush {

class EditorMessages {
public:
    // A file was opened: the next images show whether the camera sees any object.
    void opened() { checks_visible_objects_ = true; }
    // For each frame of the current document.
    void update(const Frame& frame, const Scene& scene, Toasts& toasts);
    // Shows the raw image if it cannot be denoised.
    void update(const SessionStatus& status, UiState& ui);

private:
    std::shared_ptr<const std::vector<Diagnostic>> known_;
    bool checks_visible_objects_ = false;
    std::string last_not_continued_;
};

} // namespace blush
