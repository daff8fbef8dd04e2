// Mixes light groups, each with its gain, into an image.
#pragma once

#include "render/frame.h"
#include "render/light_mix/light_groups.h"

#include <optional>
#include <span>
#include <vector>

namespace blush {

class Workers;

// A plane of width * height * 3 values.
using PlaneSpan = std::span<const float>;
PlaneSpan span_of(const std::vector<Vec3>& plane);
std::vector<PlaneSpan> planes_of(const Frame& frame); // of its groups

// The sum of all planes, each times its gain, width * height * 3 values. Memory-bound: 8 planes of 1280x720 take some
// milliseconds. `workers`: share the work; null: single-threaded.
void mix_rgb(std::span<const PlaneSpan> planes, std::span<const Vec3> gains, std::span<float> rgb, const Workers* workers = nullptr);
// Subsampled planes: every `step`-th pixel of every `step`-th row, starting at the middle of the first; width / step by height /
// step pixels, at least 1x1. They mix like full planes, in a fraction of the time.
struct SubsampledPlanes {
    int width = 0, height = 0;
    std::vector<std::vector<float>> planes;
    std::vector<PlaneSpan> spans() const { return {planes.begin(), planes.end()}; }
};
SubsampledPlanes subsampled(std::span<const PlaneSpan> planes, int width, int height, int step);
// Mixes the planes of a frame in the layout of its rgba, with the frame's alpha. `rgba` is resized as needed: reuse it, because
// allocating new memory takes as long as mixing.
void mix_rgba(const Frame& frame, std::span<const Vec3> gains, std::vector<float>& rgba, const Workers* workers = nullptr);
std::vector<float> mixed_rgba(const Frame& frame, std::span<const Vec3> gains);

// A frame's groups, each times its gain: their contributions to the image.
std::vector<std::vector<Vec3>> mixed_groups(const Frame& frame);

// Statistics of a group in a mix.
struct GroupReport {
    std::string name;
    double energy = 0; // its share of the image's luminance
    // Its share of the variance, channels together; assumes independent groups. nullopt: no variance is known yet.
    std::optional<double> noise;
};
std::vector<GroupReport> report_groups(const Frame& frame, std::span<const std::string> names, std::span<const Vec3> gains);

// Predicted RMSE of the frame with other gains: scaled as the sum of the groups' variances. 0: unknown.
double predicted_rmse(const Frame& frame, std::span<const Vec3> gains);

} // namespace blush
