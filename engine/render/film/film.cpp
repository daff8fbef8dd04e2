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
    return bytes(half_buffers_[0]) + bytes(half_buffers_[1]) + bytes(features_) + bytes(covered_) + bytes(caught_) + bytes(depth_) +
           bytes(object_id_) + bytes(material_) + bytes(paths_) + bounces_.memory_bytes() + groups_.memory_bytes() +
           strategies_.memory_bytes() + splats_.memory_bytes();
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
    for (std::vector<HalfBuffer>& half : half_buffers_) half.assign(n, {});
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
    const HalfBuffer &a = half_buffers_[0][pixel], &b = half_buffers_[1][pixel];
    return a.sum.value() + b.sum.value();
}

// The excess divides by sqrt(mean^2 + 0.1^2), and luminance is at most 0.716 of the sum of the components.
constexpr double darkest_mean = 0.1, max_luminance_of_sum = 0.716;

float Film::least_notable_sum() const {
    const float limit = std::min(std::numeric_limits<float>::max(), clamp_.min_clamped_sum());
    return std::min(limit, float(double(health_.min_excess()) * darkest_mean / max_luminance_of_sum));
}

bool Film::is_notable(size_t pixel, int samples, double sum) const {
    const HalfBuffer &a = half_buffers_[0][pixel], &b = half_buffers_[1][pixel];
    const double count = double(a.count + b.count + samples), least = double(health_.min_excess());
    if (sum > double(std::min(std::numeric_limits<float>::max(), clamp_.min_clamped_sum()))) return true;
    // A lower bound of the mean during these samples, times their number.
    const double least_total = std::max(luminance(sum_of(pixel)), darkest_mean * count);
    // No sample exceeds n times the mean of n samples.
    return count > least && sum * max_luminance_of_sum * count > least * least_total;
}

void Film::add_planes(size_t pixel, int half, const TileScratch& tile, int slot, const ClampStats::ClampResult& left) {
    const size_t place = place_of(pixel, half);
    const bool first_of_pixel = half_buffers_[0][pixel].count + half_buffers_[1][pixel].count == 0;
    if (needs_first_hits()) add_first_hit(pixel, place, *tile.first, slot, first_of_pixel);
    if (planes_.bounces > 0) bounces_.add(place, tile, slot, left.first_scaled, left.scale);
    if (needs_groups() > 0) groups_.add(pixel, half, *tile.groups, slot, left.first_scaled, left.scale);
    if (planes_.strategies)
        strategies_.add(pixel, half, tile.strategies->light, slot, left.first_scaled, left.scale,
                        int(FoundBy::manifold)); // all from it on are indirect
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
    half_buffers_[size_t(at.sample & 1)][pixel].add(left.radiance);
    const double mean = luminance(sum_of(pixel)) / double(half_buffers_[0][pixel].count + half_buffers_[1][pixel].count);
    const double bright = luminance(radiance);
    const float excess = float(bright / std::sqrt(mean * mean + darkest_mean * darkest_mean));
    if (excess >= health_.min_excess()) findings.fireflies.push_back({excess, float(bright), at.x, at.y, at.sample, at.seed});
}

void Film::add(const TileJob& job, const TileScratch& tile, uint32_t seed, const Diagnose& diagnose, const CatcherColumns* caught) {
    const bool planes = has_planes();
    const float surely_ordinary = least_notable_sum();
    Findings findings;
    int slot = 0;
    for (int y = job.y; y < job.y + job.height; ++y) {
        for (int x = job.x; x < job.x + job.width; ++x) {
            const size_t pixel = size_t(y) * size_t(width_) + size_t(x);
            double brightest = 0;
            for (int s = slot; s < slot + job.samples; ++s) brightest = std::max(brightest, tile.r[s] + tile.g[s] + tile.b[s]);
            const double notable = brightest <= surely_ordinary || is_notable(pixel, job.samples, brightest) ? surely_ordinary : brightest;
            for (int s = 0; s < job.samples; ++s, ++slot) {
                const int64_t sample = job.sample(s);
                const double r = tile.r[slot], g = tile.g[slot], b = tile.b[slot];
                // One comparison for ordinary samples; the expensive checks only for the rest.
                if (r >= 0 && g >= 0 && b >= 0 && r + g + b <= notable) {
                    if (planes) add_planes(pixel, int(sample & 1), tile, slot, {});
                    if (caught) add_caught(place_of(pixel, sample), tile, *caught, slot, {r, g, b});
                    half_buffers_[size_t(sample & 1)][pixel].add({r, g, b});
                } else {
                    add_notable(pixel, {x, y, sample, seed}, tile, slot, diagnose, findings, caught);
                }
            }
        }
    }
    if (!findings.dropped.empty()) health_.add_dropped(findings.dropped, size_t(width_), size_t(width_) * size_t(height_));
    if (!findings.fireflies.empty()) health_.add_fireflies(findings.fireflies);
}

void Film::begin_light_paths(const FilmSize& size) {
    require_memory(size);
    light_paths_ = true;
    splats_.reset(size_t(width_) * size_t(height_), planes_.bounces, group_count_);
}

void Film::add_pass(int64_t pass, std::span<const std::span<const Splat>> tiles, const Workers& workers, uint32_t seed, double traced) {
    const std::vector<BadSample> dropped = splats_.add_pass(pass, tiles, width_, seed, workers, traced);
    if (!dropped.empty()) health_.add_dropped(dropped, size_t(width_), size_t(width_) * size_t(height_));
}

void Film::add_to_first_sample(const TileJob& job, const TileScratch& tile, const EdgePixels& pixels, double sign) {
    for (int slot = 0; slot < job.paths(); ++slot) {
        const int x = job.x + slot % job.width, y = job.y + slot / job.width;
        const size_t pixel = size_t(y) * size_t(width_) + size_t(x);
        HalfBuffer& half = half_buffers_[0][pixel];
        if (!pixels.has(x, y) || half.count == 0) continue;
        const auto add = [&](ExactSum3& sum, const auto& c) { sum.add(Vec3d{c.r[slot], c.g[slot], c.b[slot]} * sign); };
        add(half.sum, tile);
        if (bounces_.planes() > 0) bounces_.add(place_of(pixel, 0), tile, slot, 0, sign);
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

} // namespace blush
