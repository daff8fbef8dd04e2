// Reads the sums of a film: frames and errors.
#include "core/math.h"
#include "render/film/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blush {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr Vec3 unknown{not_a_number, not_a_number, not_a_number}; // half difference where a half holds no samples

Vec3 to_float(const Vec3d& v) { return {float(v.x), float(v.y), float(v.z)}; }

} // namespace

// Mean of a plane over all samples of a pixel, from one or two places.
template <class Sum> auto Film::mean_of(size_t pixel, const Weights& w, const Sum& sum) const {
    return adaptive_ ? sum(2 * pixel) * w.a + sum(2 * pixel + 1) * w.b : sum(pixel) * w.a;
}

// Composites the shadow over the background behind the catcher.
void Film::resolve_caught(float* rgba, size_t pixel, const Weights& w) const {
    const auto mean = [&](auto member) { return mean_of(pixel, w, [&](size_t place) { return (caught_[place].*member).value(); }); };
    const double shadow = shadow_alpha(mean(&CaughtSums::unoccluded), mean(&CaughtSums::arriving));
    if (shadow == 0) return;
    const Vec3d behind = mean(&CaughtSums::radiance) * shadow;
    rgba[0] -= float(behind.x);
    rgba[1] -= float(behind.y);
    rgba[2] -= float(behind.z);
    for (int c = 0; c < 3; ++c) rgba[c] = std::max(rgba[c], 0.f); // rounding residue of equal sums
    if (!transparent_) return;
    const double open = mean_of(pixel, w, [&](size_t place) { return caught_[place].open; });
    rgba[3] = std::min(rgba[3] + float(shadow * open), 1.f);
}

double Film::shadow_variance(size_t pixel) const {
    if (caught_.empty() || !adaptive_) return 0;
    const CaughtSums &a = caught_[2 * pixel], &b = caught_[2 * pixel + 1];
    if (!(a.unoccluded.value() > 0) || !(b.unoccluded.value() > 0)) return 0;
    const auto alpha = [](const CaughtSums& sums) { return shadow_alpha(sums.unoccluded.value(), sums.arriving.value()); };
    const double difference = alpha(a) - alpha(b);
    return difference * difference / 2;
}

void Film::Totals::merge(const Totals& other) {
    kept = kept + other.kept;
    removed = removed + other.removed;
    clamped += other.clamped;
    has_both_halves |= other.has_both_halves;
    for (size_t k = 0; k < groups.size(); ++k) {
        groups[k].mean = groups[k].mean + other.groups[k].mean;
        groups[k].variance = groups[k].variance + other.groups[k].variance;
    }
}

Vec3d Film::group_sum(size_t pixel, int half, size_t group) const {
    const Vec3d samples = groups_.sum(pixel, half, group).value();
    if (!splats_.on()) return samples;
    return samples + splats_.group_for(pixel, half, group, half_buffers_[size_t(half)][pixel].count);
}

Vec3d Film::mixed_sum(size_t pixel, int half) const {
    Vec3d all{0, 0, 0};
    for (size_t k = 0; k < gains_.size(); ++k) {
        const Vec3& g = gains_[k];
        all = all + group_sum(pixel, half, k) * Vec3d{double(g.x), double(g.y), double(g.z)};
    }
    return all;
}

Vec3d Film::strategy_sum(size_t pixel, int half, FoundBy by) const {
    if (by != FoundBy::light_path) return strategies_.sum(pixel, half, size_t(by)).value();
    if (!splats_.on()) return {0, 0, 0};
    return splats_.sum_for(pixel, half, half_buffers_[size_t(half)][pixel].count);
}

void Film::resolve_groups(Frame& frame, size_t pixel, const Weights& w, std::vector<GroupShare>& shares) const {
    const double na = double(half_buffers_[0][pixel].count), nb = double(half_buffers_[1][pixel].count);
    // The square of |A - B| times this is an unbiased estimate of the variance of the weighted mean.
    const double k = na > 0 && nb > 0 ? std::sqrt(na * w.a * nb * w.b) : 0;
    for (size_t g = 0; g < frame.groups.size(); ++g) {
        const Vec3d a = group_sum(pixel, 0, g), b = group_sum(pixel, 1, g);
        const Vec3d mean = a * w.a + b * w.b;
        frame.groups[g][pixel] = {float(mean.x), float(mean.y), float(mean.z)};
        shares[g].mean = shares[g].mean + mean;
        const Vec3d difference = (a * (1 / na) - b * (1 / nb)) * k;
        if (wants_half_difference()) frame.group_half_differences[g][pixel] = k > 0 ? to_float(difference) : unknown;
        if (k > 0) shares[g].variance = shares[g].variance + difference * difference;
    }
}

void Film::resolve_rows(Frame& frame, int first, int last, Totals& totals) const {
    for (size_t i = size_t(first) * size_t(width_); i < size_t(last) * size_t(width_); ++i) {
        const HalfBuffer &a = half_buffers_[0][i], &b = half_buffers_[1][i];
        const int64_t count = a.count + b.count;
        const Weights w = weights(a, b);
        float* rgba = &frame.rgba[4 * i];
        const Vec3d sum_a = sum(i, 0), sum_b = sum(i, 1);
        rgba[0] = float(sum_a.x * w.a + sum_b.x * w.b);
        rgba[1] = float(sum_a.y * w.a + sum_b.y * w.b);
        rgba[2] = float(sum_a.z * w.a + sum_b.z * w.b);
        rgba[3] = transparent_ ? float(mean_of(i, w, [&](size_t place) { return double(covered_[place]); })) : count > 0 ? 1.f : 0.f;
        if (catches_) resolve_caught(rgba, i, w);
        if (adaptive_) frame.pixel_samples[i] = float(count);
        // Denoiser inputs may weight all samples equally.
        const double inverse = 1 / double(std::max<int64_t>(1, count));
        const auto mean = [&](const double(&sum)[3]) {
            return Vec3{float(sum[0] * inverse), float(sum[1] * inverse), float(sum[2] * inverse)};
        };
        if (planes_.albedo) frame.albedo[i] = mean(features_[i].albedo);
        if (planes_.normal) frame.normal[i] = mean(features_[i].normal);
        if (planes_.depth) frame.depth[i] = depth_[i];
        if (planes_.ids) {
            frame.object_id[i] = object_id_[i];
            frame.material_id[i] = uint32_t(material_[i]) + 1;
        }
        for (size_t k = 0; k < frame.bounces.size(); ++k) {
            Vec3d light = mean_of(i, w, [&](size_t place) { return bounces_.sum(place, k).value(); });
            if (splats_.on()) light = light + splats_.bounce_for(i, 0, k, a.count) * w.a + splats_.bounce_for(i, 1, k, b.count) * w.b;
            frame.bounces[k][i] = {float(light.x), float(light.y), float(light.z)};
        }
        for (size_t k = 0; k < frame.strategies.size(); ++k) {
            const Vec3d light = strategy_sum(i, 0, FoundBy(k)) * w.a + strategy_sum(i, 1, FoundBy(k)) * w.b;
            frame.strategies[k][i] = {float(light.x), float(light.y), float(light.z)};
        }
        if (wants_half_difference()) frame.half_difference[i] = half_difference(i);
        totals.has_both_halves |= a.count > 0 && b.count > 0;
        if (!frame.groups.empty()) resolve_groups(frame, i, w, totals.groups);
        if (planes_.roulette) {
            const Vec3d p = mean_of(i, w, [&](size_t place) { return paths_[place]; });
            frame.path_length[i] = float(p.x);
            frame.survival[i] = p.y > 0 ? float(p.z / p.y) : 1.f;
        }
        if (clamp_.on()) {
            totals.kept = totals.kept + unmixed_sum(i, 0) * w.a + unmixed_sum(i, 1) * w.b;
            totals.removed = totals.removed + mean_of(i, w, [&](size_t place) { return clamp_.account(place).removed.value(); });
            totals.clamped += adaptive_ ? clamp_.account(2 * i).samples + clamp_.account(2 * i + 1).samples : clamp_.account(i).samples;
        }
    }
}

size_t Film::count_bands() const { return size_t((height_ + band_rows - 1) / band_rows); }

void Film::for_each_band(const Workers& workers, const std::function<void(size_t band, int first, int last)>& task) const {
    workers.for_each(int64_t(count_bands()), {},
                     [&](int64_t i, unsigned) { task(size_t(i), int(i) * band_rows, std::min(height_, int(i + 1) * band_rows)); });
}

PixelHalfBuffers Film::half_buffers(size_t pixel) const {
    const HalfBuffer &a = half_buffers_[0][pixel], &b = half_buffers_[1][pixel];
    if (a.count == 0 || b.count == 0) return {};
    const double na = double(a.count), nb = double(b.count);
    return {true, sum(pixel, 0) / na, sum(pixel, 1) / nb, na * weights(a, b).a};
}

void Film::load_half_buffers(int y, float scale, const EdgePixels* edges, HalfBufferRow& row) const {
    // Cached weights: most pixels have as many samples as the one before.
    struct Counted {
        int64_t a = -1, b = -1;
        bool known = false;
        double own_a = 0, own_b = 0, to_a = 0, to_b = 0; // factors for sums
        float weight_a = 0, one_sample = 0;
    } n;
    for (int x = 0; x < width_; ++x) {
        const size_t i = size_t(y) * size_t(width_) + size_t(x);
        const HalfBuffer &a = half_buffers_[0][i], &b = half_buffers_[1][i];
        if (a.count != n.a || b.count != n.b) {
            const Weights w = weights(a, b);
            const double s = double(scale), na = double(a.count), nb = double(b.count);
            const bool known = a.count > 0 && b.count > 0;
            n = {a.count,
                 b.count,
                 known,
                 w.a * s,
                 w.b * s,
                 s / na,
                 s / nb,
                 known ? float(na * w.a) : 0.5f,
                 known ? float(1 / (na + nb)) : 0.f};
        }
        const Vec3d sum_a = sum(i, 0), sum_b = sum(i, 1);
        const auto set = [&](size_t c, double of_a, double of_b) {
            const float own = float(of_a * n.own_a + of_b * n.own_b);
            row.own[c][x] = own;
            row.a[c][x] = n.known ? float(of_a * n.to_a) : own;
            row.b[c][x] = n.known ? float(of_b * n.to_b) : own;
        };
        set(0, sum_a.x, sum_b.x);
        set(1, sum_a.y, sum_b.y);
        set(2, sum_a.z, sum_b.z);
        row.weight_a[x] = n.weight_a;
        row.known[x] = n.known ? 1.f : 0.f;
        row.one_sample[x] = n.one_sample;
        row.one_emission_sample[x] = edges ? n.one_sample / float(edges->fewest_near(x, y)) : n.one_sample;
    }
}

ErrorEstimate Film::estimate_error(const Workers& workers, double sharing, const EdgePixels* edges) const {
    // A single sample has no second half to compare with.
    size_t i = 0;
    const size_t n = size_t(width_) * size_t(height_);
    while (i < n && !half_buffers(i).known) ++i;
    if (i == n) return {};
    const HalfBufferImage image{width_, height_, [&](int y, float scale, HalfBufferRow& row) { load_half_buffers(y, scale, edges, row); }};
    std::vector<ErrorSums> bands(count_bands());
    for_each_band(workers, [&](size_t band, int first, int last) { bands[band] = sum_errors(image, first, last); });
    ErrorSums sums;
    for (const ErrorSums& band : bands) sums.merge(band);
    return blush::estimate_error(sums, sharing);
}

void Film::resolve(Frame& frame, const Workers& workers) const {
    const size_t n = size_t(width_) * size_t(height_);
    frame.width = width_;
    frame.height = height_;
    frame.transparent = catches_ && transparent_;
    frame.rgba.resize(4 * n);
    frame.pixel_samples.resize(adaptive_ ? n : 0);
    frame.albedo.resize(planes_.albedo ? n : 0);
    frame.normal.resize(planes_.normal ? n : 0);
    frame.depth.resize(planes_.depth ? n : 0);
    frame.object_id.resize(planes_.ids ? n : 0);
    frame.material_id.resize(planes_.ids ? n : 0);
    frame.bounces.resize(size_t(planes_.bounces));
    for (std::vector<Vec3>& plane : frame.bounces) plane.resize(n);
    frame.strategies.resize(planes_.strategies ? size_t(found_by_count) : 0);
    for (std::vector<Vec3>& plane : frame.strategies) plane.resize(n);
    frame.groups.resize(size_t(needs_groups()));
    for (std::vector<Vec3>& plane : frame.groups) plane.resize(n);
    frame.half_difference.resize(wants_half_difference() ? n : 0);
    frame.group_half_differences.resize(wants_half_difference() ? frame.groups.size() : 0);
    for (std::vector<Vec3>& plane : frame.group_half_differences) plane.resize(n);
    frame.gains = gains_;
    frame.path_length.resize(planes_.roulette ? n : 0);
    frame.survival.resize(planes_.roulette ? n : 0);
    frame.standard_error = planes_.error ? standard_error() : std::vector<Vec3>();
    frame.health = health_.health();
    frame.error = {};

    const Totals none{.groups = std::vector<GroupShare>(frame.groups.size())};
    std::vector<Totals> totals(count_bands(), none);
    for_each_band(workers, [&](size_t band, int first, int last) { resolve_rows(frame, first, last, totals[band]); });
    Totals total = none;
    for (const Totals& t : totals) total.merge(t);
    if (!total.has_both_halves) {
        frame.half_difference.clear();
        frame.group_half_differences.clear();
    }
    frame.group_shares = total.groups;
    for (GroupShare& share : frame.group_shares) share = {share.mean / double(n), share.variance / double(n)};
    const double before = luminance(total.kept) + luminance(total.removed);
    frame.clamp = {total.clamped, total.removed / double(n), before > 0 ? luminance(total.removed) / before : 0};
}

Vec3 Film::half_difference(size_t pixel) const {
    const HalfBuffer &a = half_buffers_[0][pixel], &b = half_buffers_[1][pixel];
    if (a.count == 0 || b.count == 0) return unknown;
    const double na = double(a.count), nb = double(b.count);
    const Weights w = weights(a, b);
    return to_float((sum(pixel, 0) / na - sum(pixel, 1) / nb) * std::sqrt(na * w.a * nb * w.b));
}

std::vector<Vec3> Film::standard_error() const {
    const size_t n = size_t(width_) * size_t(height_);
    std::vector<Vec3> result;
    result.reserve(n);
    for (size_t i = 0; i < n; ++i) {
        const HalfBuffer &a = half_buffers_[0][i], &b = half_buffers_[1][i];
        if (a.count == 0 || b.count == 0) return {};
        const Vec3 half = half_difference(i);
        result.push_back({std::abs(half.x), std::abs(half.y), std::abs(half.z)});
    }
    return result;
}

} // namespace blush
