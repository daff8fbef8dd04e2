#include "render/light_mix/light_mix.h"

#include "core/math.h"
#include "core/parallel.h"
#include "scene/affine.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace blush {
namespace {

// Values per block: fits the L1 cache, a multiple of the values of a pixel and of a register.
constexpr size_t run = 48;
constexpr size_t chunk = 32 * run;

using Sums = std::array<float, chunk>;

// Reads whole blocks, also past the end if the planes have room there.
void add_plane(const float* plane, size_t count, const Vec3& gain, Sums& sums) {
    std::array<float, run> pattern;
    for (size_t i = 0; i < run; i += 3) {
        pattern[i] = gain.x;
        pattern[i + 1] = gain.y;
        pattern[i + 2] = gain.z;
    }
    size_t first = 0;
    for (; first + run <= count; first += run)
        for (size_t i = 0; i < run; ++i) sums[first + i] += pattern[i] * plane[first + i];
    for (size_t i = first; i < count; ++i) sums[i] += pattern[i - first] * plane[i];
}

constexpr size_t pixels_at_once = chunk / 3;

void mix_chunk(std::span<const PlaneSpan> planes, std::span<const Vec3> gains, size_t first_pixel, size_t pixels, Sums& sums) {
    sums.fill(0);
    for (size_t k = 0; k < planes.size(); ++k)
        if (gains[k] != Vec3{0, 0, 0}) add_plane(&planes[k][3 * first_pixel], 3 * pixels, gains[k], sums);
}

// Calls take(first, count, sums) for each block of pixels.
template <class Take>
void mix_all(std::span<const PlaneSpan> planes, std::span<const Vec3> gains, size_t pixels, const Workers* workers, const Take& take) {
    const auto mix = [&](size_t begin, size_t end) {
        Sums sums;
        for (size_t first = begin; first < end; first += pixels_at_once) {
            const size_t count = std::min(pixels_at_once, end - first);
            mix_chunk(planes, gains, first, count, sums);
            take(first, count, sums);
        }
    };
    if (!workers) return mix(0, pixels);
    // Tasks of several rows: starting a task costs as much as one chunk.
    constexpr size_t task = 64 * pixels_at_once;
    workers->for_each(int64_t((pixels + task - 1) / task), {},
                      [&](int64_t i, unsigned) { mix(size_t(i) * task, std::min(pixels, (size_t(i) + 1) * task)); });
}

double variance_of(const GroupShare& share, const Vec3& gain) {
    const auto channel = [](double variance, float g) { return variance * double(g) * double(g); };
    return channel(share.variance.x, gain.x) + channel(share.variance.y, gain.y) + channel(share.variance.z, gain.z);
}

double variance_of(const Frame& frame, std::span<const Vec3> gains) {
    double sum = 0;
    for (size_t k = 0; k < frame.group_shares.size(); ++k) sum += variance_of(frame.group_shares[k], gains[k]);
    return sum;
}

} // namespace

PlaneSpan span_of(const std::vector<Vec3>& plane) {
    static_assert(sizeof(Vec3) == 3 * sizeof(float));
    if (plane.empty()) return {};
    return {&plane.front().x, 3 * plane.size()};
}

std::vector<PlaneSpan> planes_of(const Frame& frame) {
    std::vector<PlaneSpan> planes;
    for (const std::vector<Vec3>& plane : frame.groups) planes.push_back(span_of(plane));
    return planes;
}

void mix_rgb(std::span<const PlaneSpan> planes, std::span<const Vec3> gains, std::span<float> rgb, const Workers* workers) {
    mix_all(planes, gains, rgb.size() / 3, workers,
            [&](size_t first, size_t count, const Sums& sums) { std::copy_n(sums.begin(), 3 * count, &rgb[3 * first]); });
}

SubsampledPlanes subsampled(std::span<const PlaneSpan> planes, int width, int height, int step) {
    SubsampledPlanes thin{std::max(width / step, 1), std::max(height / step, 1), {}};
    const int first_x = std::min(step / 2, width - 1), first_y = std::min(step / 2, height - 1);
    for (const PlaneSpan& plane : planes) {
        std::vector<float>& values = thin.planes.emplace_back(3 * size_t(thin.width) * size_t(thin.height));
        float* to = values.data();
        for (int row = 0; row < thin.height; ++row) {
            const float* from = &plane[3 * (size_t(first_y + row * step) * size_t(width) + size_t(first_x))];
            for (int x = 0; x < thin.width; ++x, from += 3 * step, to += 3) std::copy_n(from, 3, to);
        }
    }
    return thin;
}

void mix_rgba(const Frame& frame, std::span<const Vec3> gains, std::vector<float>& rgba, const Workers* workers) {
    const std::vector<PlaneSpan> planes = planes_of(frame);
    rgba.resize(frame.rgba.size());
    mix_all(planes, gains, rgba.size() / 4, workers, [&](size_t first, size_t count, const Sums& sums) {
        const float* from = &frame.rgba[4 * first];
        float* to = &rgba[4 * first];
        for (size_t i = 0; i < count; ++i) {
            for (size_t c = 0; c < 3; ++c) to[4 * i + c] = sums[3 * i + c];
            to[4 * i + 3] = from[4 * i + 3];
        }
    });
}

std::vector<float> mixed_rgba(const Frame& frame, std::span<const Vec3> gains) {
    std::vector<float> rgba;
    mix_rgba(frame, gains, rgba);
    return rgba;
}

std::vector<std::vector<Vec3>> mixed_groups(const Frame& frame) {
    std::vector<std::vector<Vec3>> groups = frame.groups;
    for (size_t k = 0; k < groups.size(); ++k)
        if (frame.gains[k] != Vec3{1, 1, 1})
            for (Vec3& pixel : groups[k]) pixel = pixel * frame.gains[k];
    return groups;
}

std::vector<GroupReport> report_groups(const Frame& frame, std::span<const std::string> names, std::span<const Vec3> gains) {
    std::vector<GroupReport> reports;
    double energy = 0;
    const double noise = variance_of(frame, gains);
    for (size_t k = 0; k < frame.group_shares.size(); ++k) {
        const GroupShare& share = frame.group_shares[k];
        reports.push_back({names[k], luminance(share.mean * to_double(gains[k])), std::nullopt});
        if (noise > 0) reports.back().noise = variance_of(share, gains[k]) / noise;
        energy += reports.back().energy;
    }
    if (energy > 0)
        for (GroupReport& r : reports) r.energy /= energy;
    return reports;
}

double predicted_rmse(const Frame& frame, std::span<const Vec3> gains) {
    const double known = variance_of(frame, frame.gains);
    return known > 0 && frame.error.rmse_known ? frame.error.rmse * std::sqrt(variance_of(frame, gains) / known) : 0;
}

} // namespace blush
