#include "scene/lights/ies_profile.h"

#include "core/math.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

// The interval of `angles` that contains `at`, and the position in it; none if `at` is outside.
struct Place {
    size_t below = 0, above = 0;
    double fraction = 0;
    bool inside = false;
};
Place place_of(const std::vector<float>& angles, double at) {
    if (angles.size() < 2) return {0, 0, 0, !angles.empty()};
    if (!(at >= double(angles.front()) && at <= double(angles.back()))) return {};
    const size_t above = std::clamp<size_t>(size_t(std::ranges::upper_bound(angles, float(at)) - angles.begin()), 1, angles.size() - 1);
    const double low = double(angles[above - 1]), high = double(angles[above]);
    return {above - 1, above, (at - low) / (high - low), true};
}

// Integration steps of at most 10 degrees, in each of which the integrand is smooth; a single angle means a full turn.
std::vector<double> borders(const std::vector<float>& angles) {
    const double first = angles.size() < 2 ? 0 : double(angles.front()), last = angles.size() < 2 ? 360 : double(angles.back());
    std::vector<double> ends{std::max(first, last > 180 ? 0.0 : first)};
    for (const double end : angles.size() < 2 ? std::vector<double>{last} : std::vector<double>(angles.begin() + 1, angles.end())) {
        const double begin = ends.back(), until = std::min(end, 360.0);
        const int steps = int(std::ceil((until - begin) / 10));
        for (int k = 1; k <= steps; ++k) ends.push_back(begin + (until - begin) * k / steps);
    }
    return ends;
}

} // namespace

double candela_at(const IesProfile& p, double vertical, double horizontal) {
    const Place v = place_of(p.vertical, vertical), h = place_of(p.horizontal, horizontal);
    if (!v.inside || !h.inside) return 0;
    const auto row = [&](size_t k) {
        const float* c = &p.candela[k * p.vertical.size()];
        return double(c[v.below]) + (double(c[v.above]) - double(c[v.below])) * v.fraction;
    };
    return row(h.below) + (row(h.above) - row(h.below)) * h.fraction;
}

double candela_towards(const IesProfile& p, const Vec3d& d) {
    const double ahead = -d.z;
    if (p.type == IesProfile::Type::b)
        return candela_at(p, std::atan2(d.y, ahead) * degrees_per_radian, std::atan2(d.x, std::hypot(d.y, ahead)) * degrees_per_radian);
    const double turn = std::atan2(d.y, d.x) * degrees_per_radian;
    return candela_at(p, std::atan2(std::hypot(d.x, d.y), ahead) * degrees_per_radian, turn < 0 ? turn + 360 : turn);
}

double luminous_flux(const IesProfile& p) {
    // The integrand is bilinear times sine or cosine of the polar angle; the error of three points is far below that of the
    // measurement.
    constexpr double node[] = {-0.7745966692414834, 0, 0.7745966692414834}, weight[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    const std::vector<double> vs = borders(p.vertical), hs = borders(p.horizontal);
    double sum = 0;
    for (size_t i = 1; i < vs.size(); ++i)
        for (size_t j = 1; j < hs.size(); ++j)
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b) {
                    const double v = 0.5 * (vs[i] + vs[i - 1]) + 0.5 * node[a] * (vs[i] - vs[i - 1]);
                    const double h = 0.5 * (hs[j] + hs[j - 1]) + 0.5 * node[b] * (hs[j] - hs[j - 1]);
                    const double stretch =
                        p.type == IesProfile::Type::b ? std::cos(h / degrees_per_radian) : std::sin(v / degrees_per_radian);
                    sum += weight[a] * weight[b] * (vs[i] - vs[i - 1]) * (hs[j] - hs[j - 1]) * stretch * candela_at(p, v, h);
                }
    return sum / (degrees_per_radian * degrees_per_radian);
}

} // namespace blush
