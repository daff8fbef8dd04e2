#include "render/comparison/path_densities.h"

#include <algorithm>

namespace blush {
namespace {

// Squares of these are finite, and so are sums of them.
double bounded(double ratio) { return std::clamp(ratio, 1e-140, 1e140); }

} // namespace

bool PathDensities::possible(int s) const {
    if (s > std::min(edges, max_light_vertices + 1)) return false;
    if (s == 0) return light_can_be_hit;
    if (s == 1) return !delta[1] && nee > 0;
    return emission > 0 && !delta[size_t(s - 1)] && (s == edges || !delta[size_t(s)]);
}

double PathDensities::weight(int s) const {
    const int last = std::min(edges, max_light_vertices + 1);
    // Densities over the part that p_0, p_1 and p_2 share.
    std::array<double, size> p{};
    p[0] = toward_light[0];
    p[1] = nee;
    if (last >= 2) p[2] = emission / (toward_light[1] * geometry[1]) * (edges == 2 ? light_paths : 1);
    for (size_t i = 2; i < size_t(last); ++i)
        p[i + 1] = bounded(p[i]) * toward_camera[i - 1] * geometry[i - 1] / (toward_light[i] * geometry[i]) *
                   (int(i) + 1 == edges ? light_paths : 1);
    const double own = bounded(p[size_t(s)]);
    double sum = 0;
    for (int other = 0; other <= last; ++other) {
        if (other != s && !possible(other)) continue;
        const double ratio = other == s ? 1 : bounded(p[size_t(other)]) / own;
        sum += std::min(ratio, 1e140) * std::min(ratio, 1e140);
    }
    return 1 / sum;
}

} // namespace blush
