#include "ui/viewport/image_state.h"

namespace blush {
namespace {

ImageState drawing_state(bool preview, bool new_look) {
    if (preview) return ImageState::drawing_preview;
    return new_look ? ImageState::drawing_new_look : ImageState::drawing;
}

} // namespace

ImageStep next(ImageState state, const ImageInputs& in) {
    ImageStep step{state};
    if (in.edits_mix) step.preview_step = in.preview_step;
    const bool is_resting = is_preview(state) && !in.edits_mix; // no edit in this UI frame
    const bool paused = is_resting && in.since_mix_edit >= mix_pause_after;
    const bool waits = is_resting && !paused;
    if (waits) step.pause_in = mix_pause_after - in.since_mix_edit;

    const bool new_pixels = in.new_gains || paused;
    step.takes_frame = in.has_frame && !waits && (in.new_frame || new_pixels);
    step.takes_denoised = in.shows_denoised && !waits && (in.new_denoised || new_pixels);
    const bool new_drawing = step.takes_denoised || in.new_shader || in.new_look;

    // An image in progress is finished first, so that frames in quick succession are seen. A preview does not wait for a full
    // image: the edit must be visible at once.
    const bool may_begin = !is_drawing(state) || (step.preview_step > 1 && !is_preview(state));
    step.begins = may_begin && (step.takes_frame || (in.has_image && new_drawing));
    // A switch between raw and denoised cancels the image in progress. The blend slider does not, because each step would
    // restart it.
    step.restarts = !step.begins && is_drawing(state) && in.has_image && in.switched_to_one && !step.takes_denoised;
    if (step.begins)
        step.state = drawing_state(step.takes_frame ? step.preview_step > 1 : is_preview(state), in.new_look);
    else if (step.restarts)
        step.state = drawing_state(is_preview(state), true);

    // After a change of view settings or mix, the user waits for the current image and for the new one.
    const bool look_waits = in.new_look && !step.begins && !step.restarts;
    step.awaited = look_waits || is_preview(step.state) || step.state == ImageState::drawing_new_look;
    return step;
}

} // namespace blush
