// What the window shows, for programs that drive it (ui/window/probe.h).
#pragma once

#include "render/session/render_session.h"
#include "ui/transform/gizmo.h"
#include "ui/window/probe.h"
#include "ui/window/toasts.h"

namespace blush {

// Without what depends on the window. `shown`: the displayed frame; null: none.
ProbeState probe_state(const ImageRect& image, uint64_t revision, const Toasts& toasts, const FramePtr& shown);

} // namespace blush
