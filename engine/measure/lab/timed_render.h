// One render of a comparison, which counts its samples and its time.
#pragma once

#include "core/vec.h"
#include "render/renderer.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace blush {

class TimedRender {
public:
    // `wanted` is called often, from many threads; rendering ends without a result once it returns false.
    using Wanted = std::function<bool()>;

    // Restarts at no samples and no time. `options` count when it is called first. Throws as Renderer::update does.
    void begin(const RendererOptions& options, const Scene& scene, const RenderSettings& settings);
    // Adds `count` samples per pixel. False if it was cancelled.
    bool render(int64_t count, const Wanted& wanted);
    // Adds whole samples of all pixels until `seconds` in all have passed and there are two samples. The time exceeds it by less than
    // about that of one sample. False if it was cancelled.
    bool render_until(double seconds, const Wanted& wanted);

    // Per pixel.
    int64_t samples() const { return samples_; }
    // Of rendering, without update and resolve: processor time with one thread, which leaves out what other programs of a busy machine
    // take from it; else elapsed time.
    double seconds() const { return seconds_; }
    // After begin().
    Renderer& renderer() { return *renderer_; }

private:
    std::unique_ptr<Renderer> renderer_;
    bool single_thread_ = false;
    int64_t samples_ = 0;
    double seconds_ = 0;
};

// Scene-linear RGB of a frame, width * height, top row first.
std::vector<Vec3> rgb_of(const Frame& frame);

} // namespace blush
