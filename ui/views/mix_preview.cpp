#include "ui/views/mix_preview.h"

#include "ui/gl/reuse_buffer.h"

#include <algorithm>
#include <chrono>

namespace blush {
namespace {

using Clock = std::chrono::steady_clock;

double per_millisecond(double pixels, Clock::time_point begin) {
    return pixels / std::max(std::chrono::duration<double, std::milli>(Clock::now() - begin).count(), 1e-3);
}

std::vector<float>& room(std::shared_ptr<std::vector<float>>& pixels, size_t size, float value) {
    std::vector<float>& room = writable_buffer(pixels);
    if (room.size() != size) room.assign(size, value);
    return room;
}

} // namespace

int MixPreviewSource::planes() const {
    return (shows_raw ? int(frame->groups.size()) : 0) + (shows_denoised ? int(denoised->groups->planes.size()) : 0);
}

int MixPreview::step_in_time(const MixPreviewSource& moved, double milliseconds,
                             const std::function<double(double pixels)>& drawing) const {
    for (int step = 1; step < coarsest; ++step) {
        const double pixels = double(moved.frame->width) * moved.frame->height / (step * step), work = pixels * moved.planes();
        const bool kept = step == 1 || ((!moved.shows_raw || is_kept(raw_, moved.frame, step)) &&
                                        (!moved.shows_denoised || is_kept(denoised_, moved.denoised, step)));
        if (drawing(pixels) + work / mixing_ + (kept ? 0 : work / subsampling_) <= milliseconds) return step;
    }
    return coarsest;
}

bool MixPreview::is_kept(const Kept& kept, const std::shared_ptr<const void>& of, int step) const {
    return kept.step == step && kept.of.lock() == of;
}

void MixPreview::subsample(Kept& kept, const std::shared_ptr<const void>& of, const std::vector<PlaneSpan>& planes, int width, int height,
                           int step) {
    if (is_kept(kept, of, step)) return;
    const auto begin = Clock::now();
    kept.planes = subsampled(planes, width, height, step);
    kept.of = of;
    kept.step = step;
    subsampling_ = per_millisecond(double(kept.planes.width) * kept.planes.height * double(planes.size()), begin);
}

// On this thread only: the work is small, and the worker threads may be busy with the session's work, at low priority.
void MixPreview::mix(const Kept& kept, const Gains& gains, std::vector<float>& rgb) {
    const auto begin = Clock::now();
    mix_rgb(kept.planes.spans(), gains, rgb);
    mixing_ = per_millisecond(double(rgb.size() / 3) * double(gains.size()), begin);
}

MixPreview::Preview MixPreview::raw(const MixPreviewSource& moved, const Gains& gains, int step) {
    const Frame& frame = *moved.frame;
    const int width = std::max(frame.width / step, 1), height = std::max(frame.height / step, 1);
    const size_t pixels = size_t(width) * size_t(height);
    std::vector<float>& rgba = room(raw_.rgba, 4 * pixels, 1.f);
    if (moved.shows_raw) {
        subsample(raw_, moved.frame, planes_of(frame), frame.width, frame.height, step);
        raw_.mixed.resize(3 * pixels);
        mix(raw_, gains, raw_.mixed);
        for (size_t i = 0; i < pixels; ++i) std::copy_n(&raw_.mixed[3 * i], 3, &rgba[4 * i]);
    }
    return {width, height, raw_.rgba};
}

MixPreview::Preview MixPreview::denoised(const MixPreviewSource& moved, const Gains& gains, int step) {
    const DenoisedImage& image = *moved.denoised;
    subsample(denoised_, moved.denoised, planes_of(image), image.width, image.height, step);
    const int width = denoised_.planes.width, height = denoised_.planes.height;
    mix(denoised_, gains, room(denoised_.rgb, 3 * size_t(width) * size_t(height), 0.f));
    return {width, height, denoised_.rgb};
}

} // namespace blush
