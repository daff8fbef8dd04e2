// A thread that denoises what the session renders, when DenoiseCadence says so: beside the rendering, never in its way.
#pragma once

#include "render/denoise_cadence.h"
#include "render/denoised_picture.h"
#include "render/gate.h"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace blush {

// What a Denoiser does, as a value: tests put another one in its place.
using DenoiseFunction =
    std::function<Result<std::optional<Denoised>>(const DenoiseInput&, const DenoiseOptions&, const std::function<bool()>&)>;
// Makes one. What that holds, weights and memory, is gone with it.
using DenoiserMaker = std::function<DenoiseFunction()>;
// Of Denoisers (see there for the arguments).
DenoiserMaker denoiser_maker(std::filesystem::path weights, unsigned threads, bool low_priority);

class BackgroundDenoiser {
public:
    // Called on the thread here: what became of a frame that was offered. Null: it was no longer wanted, or could not be denoised.
    using OnAnswer = std::function<void(uint64_t image, const FramePtr& source, DenoisedPtr denoised)>;
    // Called on the thread here: denoised pictures have not been wanted for `grace_seconds`, and all that they took is freed.
    using OnRelease = std::function<void()>;
    // An empty maker: nothing is ever denoised. Else it is called on the thread here, for the first picture and for the first one after a
    // release.
    // `gate`: where it waits between layers of the network while processors are left to others; somebody who waits for a picture hurries it.
    BackgroundDenoiser(DenoiserMaker maker, double grace_seconds, Gate& gate, OnAnswer on_answer, OnRelease on_release);
    // Stops within a layer of the network, and joins.
    ~BackgroundDenoiser();
    BackgroundDenoiser(const BackgroundDenoiser&) = delete;
    BackgroundDenoiser& operator=(const BackgroundDenoiser&) = delete;

    // Not wanted, nothing is denoised or loaded. Never blocks.
    void want(bool wanted);
    // The newest frame; `image` counts images. True if an answer comes within a frame of the window and is worth waiting for. Never blocks.
    bool offer(uint64_t image, FramePtr frame);
    // Why it denoises no more: weights that are absent or damaged, for one. Empty: it can.
    std::string failure() const;

private:
    struct Task {
        uint64_t image = 0;
        FramePtr frame;
        bool promised = false; // somebody waits for it: finished even if it is no longer the newest
    };
    struct Outcome {
        DenoisedPtr picture;
        std::string failure;
    };

    void run();
    DenoiseOptions options_for(const Task& task, DenoiseQuality quality, size_t group) const;
    Result<std::vector<Denoised>> denoise_all(const Task& task, DenoiseQuality quality) const;
    Outcome denoise(const Task& task, DenoiseQuality quality);
    bool is_wanted(const Task& task) const;
    bool is_wanted_by_now(const Task& task) const; // after waiting at the gate

    void release(std::unique_lock<std::mutex>& lock);
    double seconds_to_release() const;

    DenoiserMaker maker_;
    double grace_seconds_;
    Gate& gate_;
    OnAnswer on_answer_;
    OnRelease on_release_;

    // What is asked between layers: no lock.
    std::atomic<bool> wanted_{false}, quit_{false};
    std::atomic<uint64_t> newest_image_{0};

    mutable std::mutex mutex_; // guards the following
    std::condition_variable wake_;
    Task newest_;
    DenoiseCadence cadence_;
    std::string failure_;
    double unwanted_since_ = 0;

    // The thread's own: what denoises, while it is there; the exposure scales of the last picture, one for each group of lights if those are
    // mixed, and its image.
    DenoiseFunction denoise_;
    std::vector<float> scales_;
    uint64_t scale_image_ = 0;
    std::thread thread_;
};

} // namespace blush
