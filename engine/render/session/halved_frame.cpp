#include "render/session/halved_frame.h"

#include "core/parallel.h"
#include "render/session/first_hit_sharing.h"

#include <algorithm>

namespace blush {
namespace {

// Calls fill(y) for each row of the result.
template <class Fill> void for_rows(int rows, const Workers* workers, const Fill& fill) {
    if (workers)
        workers->for_each(rows, {}, [&](int64_t y, unsigned) { fill(int(y)); });
    else
        for (int y = 0; y < rows; ++y) fill(y);
}

class Halving {
public:
    Halving(int width, int height, const Workers* workers) : width_(width), height_(height), workers_(workers) {}

    int width() const { return (width_ + 1) / 2; }
    int height() const { return (height_ + 1) / 2; }

    template <class T> std::vector<T> mean(const std::vector<T>& plane, size_t channels = 1) const {
        std::vector<T> half(plane.empty() ? 0 : size_t(width()) * size_t(height()) * channels);
        if (half.empty()) return half;
        for_rows(height(), workers_, [&](int y) {
            for (int x = 0; x < width(); ++x)
                for (size_t c = 0; c < channels; ++c) {
                    T sum{};
                    int count = 0;
                    for_block(x, y, [&](size_t pixel) {
                        sum = sum + plane[pixel * channels + c];
                        ++count;
                    });
                    half[(size_t(y) * size_t(width()) + size_t(x)) * channels + c] = sum * (1.f / float(count));
                }
        });
        return half;
    }

    std::vector<float> mean_depth(const std::vector<float>& depth) const {
        std::vector<float> half(depth.empty() ? 0 : size_t(width()) * size_t(height()));
        if (half.empty()) return half;
        for_rows(height(), workers_, [&](int y) {
            for (int x = 0; x < width(); ++x) {
                float sum = 0;
                int hits = 0, misses = 0;
                for_block(x, y, [&](size_t pixel) {
                    sum += depth[pixel];
                    ++(depth[pixel] > 0 ? hits : misses);
                });
                half[size_t(y) * size_t(width()) + size_t(x)] = hits < misses ? 0 : sum / float(hits);
            }
        });
        return half;
    }

private:
    // The pixels that (x, y) of the result covers.
    template <class Visit> void for_block(int x, int y, const Visit& visit) const {
        for (int from_y = 2 * y; from_y < std::min(2 * y + 2, height_); ++from_y)
            for (int from_x = 2 * x; from_x < std::min(2 * x + 2, width_); ++from_x)
                visit(size_t(from_y) * size_t(width_) + size_t(from_x));
    }

    int width_, height_;
    const Workers* workers_;
};

} // namespace

std::shared_ptr<const Frame> halved(const FramePtr& frame, const Workers* workers) {
    const Halving halving(frame->width, frame->height, workers);
    auto half = std::make_shared<Frame>();
    half->revision = frame->revision;
    half->look = frame->look;
    half->width = halving.width();
    half->height = halving.height();
    half->divider = 2 * frame->divider;
    half->samples = frame->samples;
    half->light_path_share = frame->light_path_share;
    half->whole = frame->whole;
    half->transparent = frame->transparent;
    half->seconds = frame->seconds;
    half->camera = frame->camera;
    if (frame->whole && !frame->albedo.empty() && !frame->normal.empty() && !frame->depth.empty())
        half->first_hits = first_hits_of(frame, frame->camera.value_or(WorldCamera{}));
    half->rgba = halving.mean(frame->rgba, 4);
    half->albedo = halving.mean(frame->albedo);
    half->normal = halving.mean(frame->normal);
    half->depth = halving.mean_depth(frame->depth);
    half->half_difference = halving.mean(frame->half_difference);
    half->light_groups = frame->light_groups;
    half->gains = frame->gains;
    for (const std::vector<Vec3>& group : frame->groups) half->groups.push_back(halving.mean(group));
    for (const std::vector<Vec3>& group : frame->group_half_differences) half->group_half_differences.push_back(halving.mean(group));
    return half;
}

} // namespace blush
