// Denoises frames of a session on a thread of its own, when DenoiseCadence schedules it, without delaying rendering.
#pragma once

#include "core/parallel.h"
#include "render/session/denoise_cadence.h"
#include "render/session/denoised_image.h"
#include "render/session/pause_gate.h"
#include "render/session/view_history_keeper.h"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace blush {

// The denoise function as a value; tests substitute their own.
using DenoiseFunction =
    std::function<Result<std::optional<Denoised>>(const DenoiseInput&, const DenoiseOptions&, const std::function<bool()>&)>;
// Creates one. Its weights and memory are freed with it.
using DenoiserMaker = std::function<DenoiseFunction()>;
// Creates functions that call Denoiser (see there for the arguments).
DenoiserMaker denoiser_maker(std::filesystem::path weights, unsigned threads, bool low_priority);

class BackgroundDenoiser {
public:
    // Called on the denoiser thread with the result for a submitted frame. Null: no longer wanted, or it failed.
    using OnAnswer = std::function<void(uint64_t image, const FramePtr& source, DenoisedPtr denoised)>;
    // Called on the denoiser thread after denoised images were not wanted for `grace_seconds` and all memory was freed.
    using OnRelease = std::function<void()>;
    // Empty maker: nothing is denoised. Otherwise called on the denoiser thread, for the first image and for the first one after
    // a release. `gate`: the thread pauses there between network layers while the window needs the processor; waiting for a
    // promised image interrupts the pause. `threads`, `low_priority`: to enlarge coarse images, as for Workers.
    BackgroundDenoiser(DenoiserMaker maker, unsigned threads, bool low_priority, double grace_seconds, PauseGate& gate, OnAnswer on_answer,
                       OnRelease on_release);
    // Stops within one layer of the network, and joins.
    ~BackgroundDenoiser();
    BackgroundDenoiser(const BackgroundDenoiser&) = delete;
    BackgroundDenoiser& operator=(const BackgroundDenoiser&) = delete;

    // Switches denoising on or off; if off, no weights are loaded. Never blocks.
    void want(bool wanted);
    // Submits the newest frame; `image` counts images. True if the result is expected within one frame of the window and is worth
    // waiting for. Never blocks.
    bool offer(uint64_t image, FramePtr frame);
    // Expected seconds per megapixel to denoise a first, coarse image; 0 if such images are not denoised or the speed is not known yet.
    double coarse_speed() const;
    // The same of an image of full size.
    double speed() const;
    // Expected seconds that a first, coarse image takes after its network: to enlarge it by first hits, or to mix it with view history, if
    // there is any of this look (Submission::look).
    double finishing_seconds(bool enlarges, uint64_t look) const;
    // A newer image was submitted: the run for an older one, unless promised, stops, so that it does not slow down the first frame. Never
    // blocks.
    void supersede(uint64_t image);
    // True while denoised images are wanted and can be made.
    bool is_on() const;
    // True while the denoiser should run alone: rendering pauses. False again before the result is handed over, or before want()
    // returns.
    bool pauses_rendering() const { return pauses_rendering_; }
    // Why denoising stopped, for example missing or damaged weights. Empty: it works.
    std::string failure() const;

private:
    struct Task {
        uint64_t image = 0;
        FramePtr frame;
        bool promised = false; // the session waits for it: finished even if a newer frame arrives
    };
    struct Outcome {
        DenoisedPtr denoised;
        std::string failure;
        double seconds_not_denoising = 0; // of preparation of the network, bias correction, enlarging, and history
        double seconds_of_enlarging = 0, seconds_of_history = 0;
    };

    // Images of the network, before their bias is corrected.
    struct NetworkOutput {
        uint64_t image = 0; // 0: none
        DenoiseQuality quality = DenoiseQuality::fast;
        std::vector<Denoised> planes; // of the whole image, or of each light group
        // Of the frame that has corrected it.
        int64_t samples = 0;
        bool is_corrected = false;
    };

    void run();
    void correct_again(std::unique_lock<std::mutex>& lock);
    Outcome finish(const FramePtr& frame, DenoiseQuality quality, std::vector<Denoised> planes);
    DenoiseOptions options_for(const Task& task, DenoiseQuality quality, size_t group) const;
    // `frame`: the task's, or that at half size.
    Result<std::vector<Denoised>> denoise_all(const Task& task, const Frame& frame, DenoiseQuality quality) const;
    Outcome denoise(const Task& task, const DenoiseCadence::Decision& decision);
    bool is_wanted(const Task& task) const;
    bool is_wanted_by_now(const Task& task) const; // after the pause gate

    // These require the mutex.
    DenoiseCadence::Decision due() const;
    bool may_correct_again() const;
    void update_pause();
    void release(std::unique_lock<std::mutex>& lock);
    double seconds_to_release() const;

    DenoiserMaker maker_;
    unsigned threads_;
    bool low_priority_;
    double grace_seconds_;
    PauseGate& gate_;
    OnAnswer on_answer_;
    OnRelease on_release_;

    // Read between layers without a lock.
    std::atomic<bool> wanted_{false}, quit_{false}, pauses_rendering_{false};
    std::atomic<uint64_t> newest_image_{0};

    mutable std::mutex mutex_; // guards the following
    std::condition_variable wake_;
    Task newest_;
    DenoiseCadence::Decision running_; // no quality: none
    DenoiseCadence cadence_;
    std::string failure_;
    double unwanted_since_ = 0;
    uint64_t history_look_ = 0;
    // Of the last coarse images; at first as measured for 1280x720 on two cores.
    double enlarging_seconds_ = 0.008, history_seconds_ = 0.006;

    // Used only by the denoiser thread: the denoiser while it exists, the exposure scales of the last image (one per light group
    // if groups are mixed) and that image.
    DenoiseFunction denoise_;
    std::optional<Workers> workers_; // empty until the first image is denoised
    ViewHistoryKeeper history_;
    NetworkOutput output_; // of the last frame of full size: frames with more samples correct it, much faster than the network
    std::vector<float> scales_;
    uint64_t scale_image_ = 0;
    std::thread thread_;
};

} // namespace blush
