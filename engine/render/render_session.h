// The one thread that owns everything that renders, and the one that denoises beside it. Their whole public face.
#pragma once

#include "render/background_denoiser.h"
#include "render/film_state.h"
#include "render/frame.h"
#include "render/renderer.h"
#include "render/showcase.h"
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
    bool low_priority = true;     // below the UI: render threads may not starve it
    bool first_hit_planes = true; // albedo, normal, depth, ids in every frame: picking, the pixel probe and the denoiser read them
    DenoiserMaker denoiser = {};  // not called before denoised pictures are wanted; empty: there are none
    double denoiser_grace = 30;   // seconds for which what it made is kept after they are wanted no more
};

struct SessionStatus {
    enum class State { idle, updating, rendering, aside, paused, complete, failed };
    State state = State::idle;
    uint64_t revision = 0;                               // the last one taken up
    double progress = 0;                                 // towards the nearest stop rule, 0 .. 1; 1 only when reached
    std::string message;                                 // failed: what went wrong
    std::array<bool, denoise_qualities> denoised_with{}; // networks that pictures were made by, and that are in memory
    std::string not_continued;                           // why this image began anew, not from the samples it was given; empty: it did not
    std::string denoiser_failure;                        // why there are no denoised pictures any more; empty: all is well
};

// The image at one moment, for a snapshot: a frame and the film that it was made of.
struct KeptFilm {
    uint64_t revision = 0;        // that was asked for
    FramePtr frame = {};          // null as film is
    std::vector<Vec3> error = {}; // standard error of each pixel's mean, RGB; empty if not known
    FilmStatePtr film = {};       // null if there is none to go on from,
    std::string why_none = {};    // and why
};

class RenderSession {
public:
    // `on_frame` is called after each publication and each change of state, on the threads here, perhaps on both at once; it must not
    // block.
    RenderSession(const SessionOptions& options, std::function<void()> on_frame);
    // Stops in mid-pass if need be, and joins.
    ~RenderSession();
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;

    // Replaces whatever was pending; never blocks. Latest wins, but what has been taken up is shown once before the next is. A submit that
    // changes nothing an image shows (stop rules, names) continues it, and so does one that changes the light of lights that are mixed: the
    // frames that follow show the new mix of the same samples.
    // `planes`: what the film holds beside the first-hit planes. To ask for more begins the image anew, to ask for less does not.
    // `film`: of an image that these scene and settings make; rendering goes on from its samples, or begins anew if they do not fit, and
    // the status says why.
    // True if the image goes on with the samples that it has.
    bool submit(uint64_t revision, const Scene& scene, const RenderSettings& settings, const PlaneSet& planes = {}, FilmStatePtr film = {});
    // Asks for the film of the image of this revision, which was seen in a frame of full resolution; what is being added to it is finished
    // first. Never blocks; the answer, announced like a frame, is taken once.
    void keep_film(uint64_t revision);
    std::optional<KeptFilm> take_kept_film();
    // A paused session still shows the first image of what is submitted, then waits.
    void pause(bool paused);
    // While true, the processors are left to whoever asks: nothing is begun for an image that has been shown, and what was begun waits at the
    // next tile, or layer of the denoiser's network. It goes on from there; that time does not count as spent rendering. What is submitted
    // of the same image waits as well; another image, and films that are asked for, do not. Never blocks.
    void stand_aside(bool aside);
    // Whether denoised pictures are made, beside the frames and at a tenth of their cost (denoise_cadence.h). Never blocks, and resets
    // nothing: those that there are stay when no more are wanted.
    void want_denoised(bool wanted);
    // The newest published frame, or null, and what is denoised of its image. Never blocks for longer than a pointer copy.
    Pictures pictures() const;
    FramePtr latest() const { return pictures().frame; }
    SessionStatus status() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace blush
