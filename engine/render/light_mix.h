// Pictures put together from groups of lights, each with its gain.
#pragma once

#include "render/frame.h"
#include "render/light_groups.h"

#include <span>
#include <vector>

namespace blush {

class Workers;

// A plane of width * height * 3 values.
using PlaneSpan = std::span<const float>;
PlaneSpan span_of(const std::vector<Vec3>& plane);
std::vector<PlaneSpan> planes_of(const Frame& frame); // of its groups

// The sum of all planes, each times its gain, width * height * 3 values. Bound by memory, not by arithmetic: 8 planes of 1280x720 take some
// milliseconds. `workers`: shares the work; null: none.
void mix_rgb(std::span<const PlaneSpan> planes, std::span<const Vec3> gains, std::span<float> rgb, const Workers* workers = nullptr);
// Every `step`-th pixel of every `step`-th row of some planes, from the middle of the first on: width / step by height / step pixels, but at
// least one each way. They are mixed like whole planes, in a fraction of the time.
struct ThinnedPlanes {
    int width = 0, height = 0;
    std::vector<std::vector<float>> planes;
    std::vector<PlaneSpan> spans() const { return {planes.begin(), planes.end()}; }
};
ThinnedPlanes thinned(std::span<const PlaneSpan> planes, int width, int height, int step);
// Those of a frame, into its rgba's layout; alpha as in the frame. `rgba` is made as large as it must be: who keeps it spares the system
// the making of new memory, which takes as long as the mixing.
void mix_rgba(const Frame& frame, std::span<const Vec3> gains, std::vector<float>& rgba, const Workers* workers = nullptr);
std::vector<float> mixed_rgba(const Frame& frame, std::span<const Vec3> gains);

// A frame's groups, each times its gain: what they give to the picture.
std::vector<std::vector<Vec3>> mixed_groups(const Frame& frame);

// What a group is worth in a mix.
struct GroupReport {
    std::string name;
    double energy = 0; // its share of the image's luminance
    double noise = 0;  // its share of the variance, channels together; groups are taken for independent
};
std::vector<GroupReport> report_groups(const Frame& frame, std::span<const std::string> names, std::span<const Vec3> gains);

// The frame's RMSE as it will be estimated with other gains: scaled as the sum of the groups' variances. 0: not known.
double predicted_rmse(const Frame& frame, std::span<const Vec3> gains);

} // namespace blush
