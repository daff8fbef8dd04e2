// Public interface of rendering: runs a Renderer on one thread and the denoiser on another.
#pragma once

#include "render/film/film_state.h"
#include "render/frame.h"
#include "render/renderer.h"
#include "render/session/background_denoiser.h"
#include "render/session/published_frames.h"
#include "render/session/submission.h"
#include "scene/render_settings.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace blush {

struct SessionOptions {
    unsigned threads = 0;         // 0: one per core
    bool low_priority = true;     // below the UI: render threads must not starve it
    bool first_hit_planes = true; // albedo, normal, depth, ids in every frame: for picking, the pixel probe and the denoiser
    bool begins_trained = true;   // the first sample after an edit uses the field of path guiding of before it (RendererOptions)
    DenoiserMaker denoiser = {};  // not called until denoised images are wanted; empty: no denoising
    double denoiser_grace = 30;   // seconds until the denoiser's memory is freed after denoised images are no longer wanted
};

struct SessionStatus {
    enum class State { idle, updating, rendering, yielding, paused, complete, failed };
    State state = State::idle;
    uint64_t revision = 0;                               // last one applied
    double progress = 0;                                 // towards the nearest stop rule, 0 .. 1; 1 only when reached
    std::string message;                                 // failed: the error
    std::array<bool, denoise_qualities> denoised_with{}; // networks used so far that are still in memory
    // why this image restarted instead of continuing from the given samples; empty: it did not
    std::string restart_reason;
    std::string denoiser_failure; // why denoising failed; empty: no error
};

// A frame and the film that it was made from, for a snapshot.
struct RequestedFilm {
    uint64_t revision = 0;        // the requested revision
    FramePtr frame = {};          // null if film is null
    std::vector<Vec3> error = {}; // standard error of each pixel's mean, RGB; empty if unknown
    FilmStatePtr film = {};       // null if unavailable,
    std::string why_none = {};    // with the reason
};

class RenderSession {
public:
    // `on_frame` is called after each publication and each change of state,
    // on the session's threads, possibly concurrently; it must not block.
    RenderSession(const SessionOptions& options, std::function<void()> on_frame);
    // Stops rendering, even within a pass, and joins the threads.
    ~RenderSession();
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;

    // Replaces the pending submission; never blocks. The latest wins, but an applied submission is shown once before the next is
    // applied. A submission that does not change the image (stop rules, names) continues it, and so does one that only changes
    // emission of mixed lights: later frames show the new mix of the same samples.
    // `planes`: film planes in addition to the first-hit planes. Requesting more restarts the image, requesting fewer does not.
    // `film`: film of the image of this scene and these settings; rendering continues from its samples, or restarts if they do
    // not fit, with the reason in the status.
    // Returns the submission with its image's identity; never null.
    SubmissionPtr submit(uint64_t revision, const Scene& scene, const RenderSettings& settings, const PlaneSet& planes = {},
                         FilmStatePtr film = {});
    // The same without a film, if the scene, the settings or the planes differ from the last submission; else returns null and
    // submits nothing. Cheap enough for every UI frame: tables with shared storage are not compared.
    SubmissionPtr submit_changes(uint64_t revision, const Scene& scene, const RenderSettings& settings, const PlaneSet& planes = {});
    // Requests the film of this revision's image, which must have been shown in full resolution; the current batch is finished
    // first. Never blocks; the result is announced like a frame and can be taken once.
    void request_film(uint64_t revision);
    std::optional<RequestedFilm> take_requested_film();
    // A paused session still shows the first image of a new submission, then waits.
    void pause(bool paused);
    // While true, rendering yields to the UI: nothing is started for an image that has been shown, and running work pauses at the
    // next tile, or denoiser layer, and resumes from there; that time does not count as render time. Submissions of the same
    // image wait too; other images, and requested films, do not. Never blocks.
    void yield_to_ui(bool yielding);
    // Enables denoised images in addition to the frames, at a tenth of their cost (denoise_cadence.h). Never blocks, and resets
    // nothing: existing ones remain after disabling.
    void want_denoised(bool wanted);
    // The latest published frame, or null, and the denoised version of its image. Blocks at most for a pointer copy.
    Images images() const;
    FramePtr latest() const { return images().frame; }
    SessionStatus status() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
