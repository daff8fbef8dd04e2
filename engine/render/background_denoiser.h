// A thread that denoises what the session renders, when DenoiseCadence says so: beside the rendering, never in its way.
#pragma once

#include "render/denoise_cadence.h"
#include "render/denoised_picture.h"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace blush {

// What a Denoiser does, as a value: tests put another one in its place.
using DenoiseFunction =
    std::function<Result<std::optional<Denoised>>(const DenoiseInput&, const DenoiseOptions&, const std::function<bool()>&)>;
// A Denoiser that is made at the first call, on the thread of that call (see Denoiser for its arguments).
DenoiseFunction denoiser_made_when_needed(std::filesystem::path weights, unsigned threads, bool low_priority);

class BackgroundDenoiser {
public:
    // Called on the thread here: what became of a frame that was offered. Null: it was no longer wanted, or could not be denoised.
    using OnAnswer = std::function<void(uint64_t image, const FramePtr& source, DenoisedPtr denoised)>;
    // An empty function never denoises.
    BackgroundDenoiser(DenoiseFunction denoise, OnAnswer on_answer);
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
    DenoiseOptions options_for(const Task& task, DenoiseQuality quality) const;
    Outcome denoise(const Task& task, const DenoiseOptions& options) const;
    bool is_wanted(const Task& task) const;

    DenoiseFunction denoise_;
    OnAnswer on_answer_;

    // What is asked between layers: no lock.
    std::atomic<bool> wanted_{false}, quit_{false};
    std::atomic<uint64_t> newest_image_{0};

    mutable std::mutex mutex_; // guards the following
    std::condition_variable wake_;
    Task newest_;
    DenoiseCadence cadence_;
    std::string failure_;

    // The thread's own: the exposure scale of the last picture, and its image.
    std::optional<float> scale_;
    uint64_t scale_image_ = 0;
    std::thread thread_;
};

} // namespace blush
