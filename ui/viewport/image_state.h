// Decides what the viewport uploads and draws next: pure, so that it is tested without a window. The viewport gathers the inputs,
// carries out the step, and says when the image is drawn.
#pragma once

#include <chrono>
#include <optional>

namespace blush {

// A light mix is shown at once while it is edited, as a preview at a lower resolution if time is short. Full resolution follows
// when the edit pauses.
enum class ImageState {
    current,          // the displayed image is finished
    drawing,          // an image is drawn, in several UI frames if it is large
    drawing_new_look, // the same after a change of view settings, which the user waits for
    preview,          // a preview of the light mix is finished: the next edit or full resolution follows
    drawing_preview,
};

constexpr bool is_drawing(ImageState s) { return s != ImageState::current && s != ImageState::preview; }
constexpr bool is_preview(ImageState s) { return s == ImageState::preview || s == ImageState::drawing_preview; }

// Time without a change after which an edit of the mix has paused: during a drag, not every UI frame has mouse input.
constexpr std::chrono::milliseconds mix_pause_after{120};

// `new_...`: compared with the last upload.
struct ImageInputs {
    bool has_frame = false;                    // a frame with pixels is published
    bool has_image = false;                    // an image was uploaded
    bool new_frame = false;                    // another frame, another plane of it, or its background shown in another way
    bool shows_denoised = false;               // raw and denoised image may both be shown
    bool new_denoised = false;                 // another denoised image
    bool new_gains = false;                    // of the light groups
    bool edits_mix = false;                    // the new gains can be applied here: to group planes of all images that are shown
    int preview_step = 1;                      // if so: every n-th pixel per axis can be mixed and drawn in this UI frame; 1: all
    bool new_look = false;                     // view settings, or weights of raw and denoised image
    bool switched_to_one = false;              // of raw and denoised image; part of new_look
    bool new_shader = false;                   // of the display transform
    std::chrono::nanoseconds since_mix_edit{}; // time since the last edit of the mix
};

struct ImageStep {
    ImageState state;         // now
    bool begins = false;      // begin an image, after the uploads
    bool takes_frame = false; // upload the frame, at preview_step
    bool takes_denoised = false;
    int preview_step = 1;
    bool restarts = false;                                 // begin again with the new look, without uploads
    bool awaited = false;                                  // the user waits for the image: spend more of the UI frame on it
    std::optional<std::chrono::nanoseconds> pause_in = {}; // ask again then: the edit of the mix may have paused
};

// The step of a UI frame in which the image is in `state`.
ImageStep next(ImageState state, const ImageInputs& in);

// The state when the image is drawn.
constexpr ImageState drawn(ImageState s) { return is_preview(s) ? ImageState::preview : ImageState::current; }

} // namespace blush
