#include "render/film/film.h"

#include "core/math.h"
#include "core/memory_limit.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace blush {

std::vector<PlaneUse> Film::plane_uses(const FilmSize& size) {
    const PlaneSet& planes = size.planes;
    const size_t places = size.adaptive ? 2 : 1; // place_of()
    const bool features = planes.albedo || planes.normal;
    const int bounces = planes.bounces > 0 ? planes.bounces : default_bounce_planes;
    return {
        {"beauty", true, "two halves, for the error estimate", 2 * sizeof(HalfBuffer)},
        {"albedo and normal", features,
         features ? "used by the denoiser, the pixel probe or a layer; recorded only during rendering" : "not used: no layer, no denoiser",
         sizeof(FeatureSums)},
        {"depth", planes.depth,
         planes.depth ? "used by focus picking, light placing, the pixel probe or a layer" : "not used: no layer, no focus picking",
         sizeof(float)},
        {"ids", planes.ids, planes.ids ? "used by picking, the outline, the pixel probe or a layer" : "not used: no layer, no picking",
         sizeof(uint32_t) + sizeof(int32_t)},
        {"coverage", size.transparent, size.transparent ? "the environment is hidden from the camera" : "the image is opaque",
         places * sizeof(int64_t)},
        {"bounces", planes.bounces > 0, planes.bounces > 0 ? "used by a layer or a view" : "not used: no layer, no view",
         places * BouncePlanes::bytes_per_pixel(bounces)},
        {"light groups", size.groups > 0, size.groups > 0 ? "the light mix is on" : "the light mix is off",
         GroupPlanes::bytes_per_pixel(std::max(1, size.groups))},
        {"caught shadows", size.catches, size.catches ? "there is a shadow catcher" : "there is no shadow catcher",
         places * sizeof(CaughtSums)},
        {"splats", size.light_paths, size.light_paths ? "light paths reach any pixel" : "there are no light paths",
         SplatPlanes::bytes_per_pixel(planes.bounces, size.groups)},
        {"strategies", planes.strategies, planes.strategies ? "used by a layer or a view" : "not used: no layer, no view",
         GroupPlanes::bytes_per_pixel(path_strategies)},
        {"path statistics", planes.roulette, planes.roulette ? "used by a roulette view" : "not used: no roulette view",
         places * sizeof(Vec3d)},
    };
}

size_t Film::memory_bytes() const {
    const auto bytes = [](const auto& plane) { return plane.capacity() * sizeof(plane[0]); };
    return bytes(half_buffers_) + bytes(features_) + bytes(covered_) + bytes(caught_) + bytes(depth_) + bytes(object_id_) +
           bytes(material_) + bytes(paths_) + bounces_.memory_bytes() + groups_.memory_bytes() + strategies_.memory_bytes() +
           splats_.memory_bytes();
}

void Film::require_memory(const FilmSize& size) {
    // Estimated before allocation, because the system's OOM killer
    // gives no message. Includes frames, and half of an adaptive pilot.
    double per_pixel = 64 + 3 * double(sizeof(Vec3)) * size.groups + (size.adaptive ? 2 * sizeof(Vec3d) : 0);
    for (const PlaneUse& plane : plane_uses(size))
        if (plane.used) per_pixel += double(plane.bytes_per_pixel);
    const double needed = per_pixel * double(size.width) * double(size.height);
    // Reading the free memory opens several files at every edit; for small films a failed allocation reports the same.
    constexpr double min_checked_bytes = 256e6;
    if (needed <= min_checked_bytes) return;
    const MemoryLimit room = memory_limit();
    if (needed > 0.8 * double(room.limit))
        throw std::runtime_error(
            fmt::format("an image of {} x {} pixels needs {:.2g} GB of memory: {}", size.width, size.height, needed / 1e9, room.text()));
}

void Film::reset(const FilmSize& size, const Clamp& clamp) {
    require_memory(size);
    width_ = size.width;
    height_ = size.height;
    planes_ = size.planes;
    transparent_ = size.transparent;
    adaptive_ = size.adaptive;
    catches_ = size.catches;
    light_paths_ = size.light_paths;
    clamping_ = clamp;
    group_count_ = size.groups;
    if (gains_.size() != size_t(size.groups)) set_gains(std::vector<Vec3>(size_t(size.groups), Vec3{1, 1, 1}));
    clear();
}

void Film::set_gains(std::span<const Vec3> gains) {
    gains_.assign(gains.begin(), gains.end());
    mixed_ = std::ranges::any_of(gains_, [](const Vec3& g) { return g != Vec3{1, 1, 1}; });
}

void Film::clear() {
    const size_t n = size_t(width_) * size_t(height_);
    half_buffers_.assign(2 * n, {});
    features_.assign(planes_.albedo || planes_.normal ? n : 0, {});
    const size_t places = adaptive_ ? 2 * n : n;
    covered_.assign(transparent_ ? places : 0, 0);
    caught_.assign(catches_ ? places : 0, {});
    depth_.assign(planes_.depth ? n : 0, 0.f);
    object_id_.assign(planes_.ids ? n : 0, 0u);
    material_.assign(planes_.ids ? n : 0, -1);
    bounces_.reset(places, planes_.bounces);
    groups_.reset(n, group_count_);
    strategies_.reset(n, planes_.strategies ? path_strategies : 0);
    splats_.reset(light_paths_ ? n : 0, planes_.bounces, group_count_);
    paths_.assign(planes_.roulette ? places : 0, Vec3d{0, 0, 0});
    clamp_.reset(places, clamping_);
    health_.reset();
}

void Film::keep_only(const PlaneSet& planes) {
    planes_ = planes;
    const auto free_unless = [](bool wanted, auto& plane) {
        if (!wanted) plane = {};
    };
    free_unless(planes.albedo || planes.normal, features_);
    free_unless(planes.depth, depth_);
    free_unless(planes.ids, object_id_);
    free_unless(planes.ids, material_);
    free_unless(planes.roulette, paths_);
    free_unless(planes.bounces > 0, bounces_);
    free_unless(planes.strategies, strategies_);
    if (planes.bounces == 0) splats_.drop_bounces();
}

Film::Weights Film::weights(const HalfBuffer& a, const HalfBuffer& b) const {
    if (adaptive_ && a.count > 0 && b.count > 0) return {0.5 / double(a.count), 0.5 / double(b.count)};
    const double each = 1 / double(std::max<int64_t>(1, a.count + b.count));
    return {each, each};
}

// Mean of a plane over all samples of a pixel, from one or two places.
template <class Sum> auto Film::mean_of(size_t pixel, const Weights& w, const Sum& sum) const {
    return adaptive_ ? sum(2 * pixel) * w.a + sum(2 * pixel + 1) * w.b : sum(pixel) * w.a;
}

void Film::add_first_hit(size_t pixel, size_t place, const FirstHitColumns& first, int slot, bool first_of_pixel) {
    if (!features_.empty()) {
        FeatureSums& f = features_[pixel];
        const float albedo[3] = {first.albedo_r[slot], first.albedo_g[slot], first.albedo_b[slot]};
        const float normal[3] = {first.normal_x[slot], first.normal_y[slot], first.normal_z[slot]};
        for (int c = 0; c < 3; ++c) {
            // On a miss the albedo may be the sun's radiance; denoiser inputs must stay in range.
            if (std::isfinite(albedo[c])) f.albedo[c] += rounded_for_sums(double(std::clamp(albedo[c], 0.f, 1.f)));
            if (std::isfinite(normal[c])) f.normal[c] += rounded_for_sums(double(normal[c]));
        }
    }
    if (transparent_) covered_[place] += first.material[slot] >= 0;
    if (!first_of_pixel) return;
    if (planes_.depth) depth_[pixel] = first.depth[slot];
    if (planes_.ids) {
        object_id_[pixel] = uint32_t(first.object[slot]);
        material_[pixel] = first.material[slot];
    }
}

// Of the samples alone: how many passes of light paths there are by now depends on how samples are asked for.
Vec3d Film::sum_of(size_t pixel) const {
    const HalfBuffer &a = half_buffers_[2 * pixel], &b = half_buffers_[2 * pixel + 1];
    return a.sum.value() + b.sum.value();
}

// Threshold for the pixel's next samples: those whose components sum
// to at most this are neither clamped nor among the worst fireflies.
float Film::notable_sum(size_t pixel, int samples) const {
    float limit = std::min(std::numeric_limits<float>::max(), clamp_.min_clamped_sum());
    const double count = double(half_buffers_[2 * pixel].count + half_buffers_[2 * pixel + 1].count + samples),
                 least = double(health_.min_excess());
    // No sample exceeds n times the mean of n samples.
    if (count <= least) return limit;
    // Lower bound of the mean during these samples; luminance is at most 0.716 of the sum.
    const double mean = luminance(sum_of(pixel)) / count;
    return std::min(limit, float(least * std::max(mean, 0.1) / 0.716)); // 0.1: the excess divides by sqrt(mean^2 + 0.01)
}

void Film::add_planes(size_t pixel, int half, const TileScratch& tile, int slot, const ClampStats::ClampResult& left) {
    const size_t place = place_of(pixel, half);
    const bool first_of_pixel = half_buffers_[2 * pixel].count + half_buffers_[2 * pixel + 1].count == 0;
    if (needs_first_hits()) add_first_hit(pixel, place, *tile.first, slot, first_of_pixel);
    if (planes_.bounces > 0) bounces_.add(place, tile, slot, left.first_scaled, left.scale);
    if (needs_groups() > 0) groups_.add(pixel, half, *tile.groups, slot, left.first_scaled, left.scale);
    if (planes_.strategies)
        strategies_.add(pixel, half, tile.strategies->light, slot, left.first_scaled, left.scale, int(FoundBy::manifold));
    if (planes_.roulette) {
        const RouletteColumns& c = *tile.roulette;
        paths_[place] =
            paths_[place] + Vec3d{double(c.length[slot]), double(c.num_rr_applied[slot]), rounded_for_sums(double(c.survival[slot]))};
    }
}

void Film::add_notable(size_t pixel, const SampleName& at, const TileScratch& tile, int slot, const Diagnose& diagnose, Findings& findings,
                       const CatcherColumns* caught) {
    const Vec3d radiance{tile.r[slot], tile.g[slot], tile.b[slot]};
    if (const auto cause = cause_to_drop(radiance)) {
        const Fault fault = diagnose ? diagnose(at.x, at.y, at.sample) : Fault{};
        findings.dropped.push_back({*cause, at.x, at.y, at.sample, at.seed, fault});
        return;
    }
    const size_t place = place_of(pixel, at.sample);
    const ClampStats::ClampResult left = clamp_.clamp(place, tile, slot);
    if (has_planes()) add_planes(pixel, int(at.sample & 1), tile, slot, left);
    if (caught) add_caught(place, tile, *caught, slot, left.radiance);
    half_buffers_[2 * pixel + size_t(at.sample & 1)].add(left.radiance);
    const double mean = luminance(sum_of(pixel)) / double(half_buffers_[2 * pixel].count + half_buffers_[2 * pixel + 1].count);
    const double bright = luminance(radiance);
    const float excess = float(bright / std::sqrt(mean * mean + 0.01));
    if (excess >= health_.min_excess()) findings.fireflies.push_back({excess, float(bright), at.x, at.y, at.sample, at.seed});
}

void Film::add(const TileJob& job, const TileScratch& tile, uint32_t seed, const Diagnose& diagnose, const CatcherColumns* caught) {
    const bool planes = has_planes();
    Findings findings;
    int slot = 0;
    for (int y = job.y; y < job.y + job.height; ++y) {
        for (int x = job.x; x < job.x + job.width; ++x) {
            const size_t pixel = size_t(y) * size_t(width_) + size_t(x);
            const float notable = notable_sum(pixel, job.samples);
            for (int s = 0; s < job.samples; ++s, ++slot) {
                const int64_t sample = job.sample(s);
                const double r = tile.r[slot], g = tile.g[slot], b = tile.b[slot];
                // One comparison for ordinary samples; the expensive checks only for the rest.
                if (r >= 0 && g >= 0 && b >= 0 && r + g + b <= notable) {
                    if (planes) add_planes(pixel, int(sample & 1), tile, slot, {});
                    if (caught) add_caught(place_of(pixel, sample), tile, *caught, slot, {r, g, b});
                    half_buffers_[2 * pixel + size_t(sample & 1)].add({r, g, b});
                } else {
                    add_notable(pixel, {x, y, sample, seed}, tile, slot, diagnose, findings, caught);
                }
            }
        }
    }
    if (!findings.dropped.empty()) health_.add_dropped(findings.dropped, size_t(width_), size_t(width_) * size_t(height_));
    if (!findings.fireflies.empty()) health_.add_fireflies(findings.fireflies);
}

void Film::add_pass(int64_t pass, std::span<const std::span<const Splat>> tiles, const Workers& workers, uint32_t seed) {
    const std::vector<BadSample> dropped = splats_.add_pass(pass, tiles, width_, seed, workers);
    if (!dropped.empty()) health_.add_dropped(dropped, size_t(width_), size_t(width_) * size_t(height_));
}

void Film::add_to_first_sample(const TileJob& job, const TileScratch& tile, const EdgePixels& pixels, double sign) {
    for (int slot = 0; slot < job.paths(); ++slot) {
        const int x = job.x + slot % job.width, y = job.y + slot / job.width;
        const size_t pixel = size_t(y) * size_t(width_) + size_t(x);
        HalfBuffer& half = half_buffers_[2 * pixel];
        if (!pixels.has(x, y) || half.count == 0) continue;
        const auto add = [&](ExactSum3& sum, const auto& c) { sum.add(Vec3d{c.r[slot], c.g[slot], c.b[slot]} * sign); };
        add(half.sum, tile);
        if (bounces_.planes() > 0) add(bounces_.sum(place_of(pixel, 0), 0), tile);
        if (strategies_.groups() > 0) add(strategies_.sum(pixel, 0, size_t(FoundBy::camera_hit)), tile);
        for (int k = 0; k < groups_.groups(); ++k) add(groups_.sum(pixel, 0, size_t(k)), tile.groups->all[size_t(k)]);
    }
}

void Film::add_caught(size_t place, const TileScratch& tile, const CatcherColumns& caught, int slot, const Vec3d& radiance) {
    if (!caught.caught[slot]) return;
    CaughtSums& sums = caught_[place];
    sums.unoccluded.add(double(caught.unoccluded[slot]));
    sums.arriving.add(double(caught.arriving[slot]));
    sums.radiance.add(radiance);
    if (transparent_) sums.open += tile.first->material[slot] < 0;
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
    for (size_t k = 0; k < groups.size(); ++k) {
        groups[k].mean = groups[k].mean + other.groups[k].mean;
        groups[k].variance = groups[k].variance + other.groups[k].variance;
    }
}

Vec3d Film::group_sum(size_t pixel, int half, size_t group) const {
    const Vec3d samples = groups_.sum(pixel, half, group).value();
    if (!splats_.on()) return samples;
    return samples + splats_.group_for(pixel, half, group, half_buffers_[2 * pixel + size_t(half)].count);
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
    return splats_.sum_for(pixel, half, half_buffers_[2 * pixel + size_t(half)].count);
}

void Film::resolve_groups(Frame& frame, size_t pixel, const Weights& w, std::vector<GroupShare>& shares) const {
    const double na = double(half_buffers_[2 * pixel].count), nb = double(half_buffers_[2 * pixel + 1].count);
    // The square of |A - B| times this is an unbiased estimate of the variance of the weighted mean.
    const double k = na > 0 && nb > 0 ? std::sqrt(na * w.a * nb * w.b) : 0;
    for (size_t g = 0; g < frame.groups.size(); ++g) {
        const Vec3d a = group_sum(pixel, 0, g), b = group_sum(pixel, 1, g);
        const Vec3d mean = a * w.a + b * w.b;
        frame.groups[g][pixel] = {float(mean.x), float(mean.y), float(mean.z)};
        shares[g].mean = shares[g].mean + mean;
        if (k == 0) continue;
        const Vec3d difference = (a * (1 / na) - b * (1 / nb)) * k;
        shares[g].variance = shares[g].variance + difference * difference;
    }
}

void Film::resolve_rows(Frame& frame, int first, int last, Totals& totals) const {
    for (size_t i = size_t(first) * size_t(width_); i < size_t(last) * size_t(width_); ++i) {
        const HalfBuffer &a = half_buffers_[2 * i], &b = half_buffers_[2 * i + 1];
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
    const HalfBuffer &a = half_buffers_[2 * pixel], &b = half_buffers_[2 * pixel + 1];
    if (a.count == 0 || b.count == 0) return {};
    const double na = double(a.count), nb = double(b.count);
    return {true, sum(pixel, 0) / na, sum(pixel, 1) / nb, na * weights(a, b).a};
}

void Film::load_half_buffers(int y, float scale, HalfBufferRow& row) const {
    // Cached weights: most pixels have as many samples as the one before.
    struct Counted {
        int64_t a = -1, b = -1;
        bool known = false;
        double own_a = 0, own_b = 0, to_a = 0, to_b = 0; // factors for sums
        float weight_a = 0, one_sample = 0;
    } n;
    for (int x = 0; x < width_; ++x) {
        const size_t i = size_t(y) * size_t(width_) + size_t(x);
        const HalfBuffer &a = half_buffers_[2 * i], &b = half_buffers_[2 * i + 1];
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
    }
}

ErrorEstimate Film::estimate_error(const Workers& workers, double sharing) const {
    // A single sample has no second half to compare with.
    size_t i = 0;
    const size_t n = size_t(width_) * size_t(height_);
    while (i < n && !half_buffers(i).known) ++i;
    if (i == n) return {};
    const HalfBufferImage image{width_, height_, [this](int y, float scale, HalfBufferRow& row) { load_half_buffers(y, scale, row); }};
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
    frame.group_shares = total.groups;
    for (GroupShare& share : frame.group_shares) share = {share.mean / double(n), share.variance / double(n)};
    const double before = luminance(total.kept) + luminance(total.removed);
    frame.clamp = {total.clamped, total.removed / double(n), before > 0 ? luminance(total.removed) / before : 0};
}

std::vector<Vec3> Film::standard_error() const {
    const size_t n = size_t(width_) * size_t(height_);
    std::vector<Vec3> result;
    result.reserve(n);
    for (size_t i = 0; i < n; ++i) {
        const HalfBuffer &a = half_buffers_[2 * i], &b = half_buffers_[2 * i + 1];
        if (a.count == 0 || b.count == 0) return {};
        const double na = double(a.count), nb = double(b.count);
        // |A - B| times the factor that makes its square an unbiased estimate of the variance of the weighted mean.
        const Weights w = weights(a, b);
        const double k = std::sqrt(na * w.a * nb * w.b);
        const Vec3d difference = sum(i, 0) / na - sum(i, 1) / nb;
        result.push_back({float(std::abs(difference.x) * k), float(std::abs(difference.y) * k), float(std::abs(difference.z) * k)});
    }
    return result;
}

} // namespace blush
