#include "app/editor/editor_probe.h"

namespace blush {

ProbeState probe_state(const ImageRect& image, uint64_t revision, const Toasts& toasts, const FramePtr& shown) {
    ProbeState state;
    state.image = {image.x, image.y, image.width, image.height};
    state.revision = revision;
    if (!toasts.all().empty()) state.toast = toasts.all().back().text;
    if (!shown) return state;
    state.width = shown->width;
    state.height = shown->height;
    state.samples = shown->samples;
    state.complete = shown->complete;
    return state;
}

} // namespace blush
