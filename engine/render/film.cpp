#include "render/film.h"

#include "core/math.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <unistd.h>

namespace blush {
namespace {

constexpr size_t remembered_bad_samples = 100;

// Radiance that single precision, which pictures are made of, cannot hold.
constexpr double beyond_radiance = double(std::numeric_limits<float>::max());

std::optional<BadSample::Cause> fault_of(double r, double g, double b) {
    if (std::isnan(r) || std::isnan(g) || std::isnan(b)) return BadSample::Cause::nan;
    if (std::max({std::abs(r), std::abs(g), std::abs(b)}) > beyond_radiance) return BadSample::Cause::infinite;
    if (r < 0 || g < 0 || b < 0) return BadSample::Cause::negative;
    return std::nullopt;
}

// Keeps the first hundred in an order that does not depend on threads.
void remember(Health& health, const std::vector<BadSample>& bad) {
    for (const BadSample& b : bad) {
        switch (b.cause) {
        case BadSample::Cause::nan: ++health.nan; break;
        case BadSample::Cause::infinite: ++health.infinite; break;
        case BadSample::Cause::negative: ++health.negative; break;
        }
    }
    health.first.insert(health.first.end(), bad.begin(), bad.end());
    std::sort(health.first.begin(), health.first.end(),
              [](const BadSample& a, const BadSample& b) { return std::tie(a.sample, a.y, a.x) < std::tie(b.sample, b.y, b.x); });
    if (health.first.size() > remembered_bad_samples) health.first.resize(remembered_bad_samples);
}

} // namespace

std::vector<PlaneUse> Film::plane_uses(const PlaneSet& planes, bool transparent_background, bool adaptive) {
    const size_t places = adaptive ? 2 : 1; // place_of()
    const bool features = planes.albedo || planes.normal;
    const int bounces = planes.bounces > 0 ? planes.bounces : usual_bounce_planes;
    return {
        {"beauty", true, "two halves, which tell the error", 2 * sizeof(Half)},
        {"albedo and normal", features, features ? "somebody reads them" : "nobody reads them: no layer, no denoiser", sizeof(FeatureSums)},
        {"depth", planes.depth, planes.depth ? "somebody reads it" : "nobody reads it", sizeof(float)},
        {"ids", planes.ids, planes.ids ? "somebody reads them" : "nobody reads them: no layer, no picking",
         sizeof(uint32_t) + sizeof(int32_t)},
        {"coverage", transparent_background, transparent_background ? "the environment is hidden from the camera" : "the picture is opaque",
         sizeof(int64_t)},
        {"bounces", planes.bounces > 0, planes.bounces > 0 ? "somebody reads them" : "nobody looks at single bounces",
         places * BouncePlanes::bytes_per_pixel(bounces)},
    };
}

size_t Film::memory_bytes() const {
    const auto bytes = [](const auto& plane) { return plane.capacity() * sizeof(plane[0]); };
    return bytes(halves_) + bytes(features_) + bytes(covered_) + bytes(depth_) + bytes(object_id_) + bytes(material_) +
           bounces_.memory_bytes();
}

void Film::require_memory(int width, int height, const PlaneSet& planes, bool adaptive) {
    // Said before the system's killer says it in its own way. Beside the planes there are frames, and half of an adaptive pilot.
    double per_pixel = 64 + (adaptive ? 2 * sizeof(Vec3d) : 0);
    for (const PlaneUse& plane : plane_uses(planes, false, adaptive))
        if (plane.used) per_pixel += double(plane.bytes_per_pixel);
    const double needed = per_pixel * double(width) * double(height);
    const double present = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
    if (needed > 0.8 * present)
        throw std::runtime_error(fmt::format("an image of {} x {} pixels needs {:.0f} GB of memory, this machine has {:.0f}", width, height,
                                             needed / 1e9, present / 1e9));
}

void Film::reset(int width, int height, const PlaneSet& planes, bool transparent_background, bool adaptive) {
    require_memory(width, height, planes, adaptive);
    width_ = width;
    height_ = height;
    planes_ = planes;
    transparent_ = transparent_background;
    adaptive_ = adaptive;
    clear();
}

void Film::clear() {
    const size_t n = size_t(width_) * size_t(height_);
    halves_.assign(2 * n, {});
    features_.assign(planes_.albedo || planes_.normal ? n : 0, {});
    const size_t places = adaptive_ ? 2 * n : n;
    covered_.assign(transparent_ ? places : 0, 0);
    depth_.assign(planes_.depth ? n : 0, 0.f);
    object_id_.assign(planes_.ids ? n : 0, 0u);
    material_.assign(planes_.ids ? n : 0, -1);
    bounces_.reset(places, planes_.bounces);
    health_ = {};
}

Film::Weights Film::weights(const Half& a, const Half& b) const {
    if (adaptive_ && a.count > 0 && b.count > 0) return {0.5 / double(a.count), 0.5 / double(b.count)};
    const double each = 1 / double(std::max<int64_t>(1, a.count + b.count));
    return {each, each};
}

// Of a plane's sums, at one or two places, over all samples of a pixel.
template <class Sum> auto Film::mean_of(size_t pixel, const Weights& w, const Sum& sum) const {
    return adaptive_ ? sum(2 * pixel) * w.a + sum(2 * pixel + 1) * w.b : sum(pixel) * w.a;
}

void Film::add_first_hit(size_t pixel, size_t place, const FirstHitColumns& first, int slot, bool first_of_pixel) {
    if (!features_.empty()) {
        FeatureSums& f = features_[pixel];
        const float albedo[3] = {first.albedo_r[slot], first.albedo_g[slot], first.albedo_b[slot]};
        const float normal[3] = {first.normal_x[slot], first.normal_y[slot], first.normal_z[slot]};
        for (int c = 0; c < 3; ++c) {
            // What a miss shows may be the sun itself: guides are for denoising and stay in range.
            if (std::isfinite(albedo[c])) f.albedo[c] += double(std::clamp(albedo[c], 0.f, 1.f));
            if (std::isfinite(normal[c])) f.normal[c] += double(normal[c]);
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

void Film::add(const TileJob& job, const TileScratch& tile, uint32_t seed) {
    std::vector<BadSample> bad;
    int slot = 0;
    for (int y = job.y; y < job.y + job.height; ++y) {
        for (int x = job.x; x < job.x + job.width; ++x) {
            const size_t pixel = size_t(y) * size_t(width_) + size_t(x);
            Half* halves = &halves_[2 * pixel];
            for (int s = 0; s < job.samples; ++s, ++slot) {
                const int64_t sample = job.sample(s);
                const double r = tile.r[slot], g = tile.g[slot], b = tile.b[slot];
                // One comparison for the many that are sound; the slow question only for the rest.
                const bool sound = r >= 0 && g >= 0 && b >= 0 && r + g + b <= beyond_radiance;
                if (!sound) {
                    if (const auto fault = fault_of(r, g, b)) {
                        bad.push_back({*fault, x, y, sample, seed});
                        continue;
                    }
                }
                const bool first_of_pixel = halves[0].count + halves[1].count == 0;
                Half& half = halves[sample & 1];
                half.r += r;
                half.g += g;
                half.b += b;
                ++half.count;
                const size_t place = place_of(pixel, sample);
                if (needs_first_hits()) add_first_hit(pixel, place, *tile.first, slot, first_of_pixel);
                if (bounces_.columns() > 0) bounces_.add(place, tile, slot);
            }
        }
    }
    if (bad.empty()) return;
    const std::lock_guard lock(health_mutex_);
    remember(health_, bad);
}

void Film::resolve_rows(Frame& frame, int first, int last) const {
    for (size_t i = size_t(first) * size_t(width_); i < size_t(last) * size_t(width_); ++i) {
        const Half &a = halves_[2 * i], &b = halves_[2 * i + 1];
        const int64_t count = a.count + b.count;
        const Weights w = weights(a, b);
        float* rgba = &frame.rgba[4 * i];
        rgba[0] = float(a.r * w.a + b.r * w.b);
        rgba[1] = float(a.g * w.a + b.g * w.b);
        rgba[2] = float(a.b * w.a + b.b * w.b);
        rgba[3] = transparent_ ? float(mean_of(i, w, [&](size_t place) { return double(covered_[place]); })) : 1.f;
        if (adaptive_) frame.pixel_samples[i] = float(count);
        // Guides for denoising, where it does no harm that all samples count alike.
        const double inverse = 1 / double(std::max<int64_t>(1, count));
        const auto mean = [&](const double(&sum)[3]) {
            return Vec3{float(sum[0] * inverse), float(sum[1] * inverse), float(sum[2] * inverse)};
        };
        if (planes_.albedo) frame.albedo[i] = mean(features_[i].albedo);
        if (planes_.normal) frame.normal[i] = mean(features_[i].normal);
        if (planes_.depth) frame.depth[i] = depth_[i];
        if (planes_.ids) {
            frame.object_id[i] = object_id_[i];
            frame.material_id[i] = uint32_t(material_[i] + 1);
        }
        for (size_t k = 0; k < frame.bounces.size(); ++k) {
            const Vec3d light = mean_of(i, w, [&](size_t place) { return bounces_.sum(place, k); });
            frame.bounces[k][i] = {float(light.x), float(light.y), float(light.z)};
        }
    }
}

ErrorAccumulator Film::error_of_rows(const Frame& frame, int first, int last) const {
    ErrorAccumulator error;
    const auto both_hold_samples = [&](size_t i) { return halves_[2 * i].count > 0 && halves_[2 * i + 1].count > 0; };
    // A drag's single samples have nothing to compare, and no time to look around.
    size_t i = size_t(first) * size_t(width_);
    const size_t end = size_t(last) * size_t(width_);
    while (i < end && !both_hold_samples(i)) ++i;
    if (i == end) return error;
    const Surroundings surroundings(frame.rgba, width_, height_, first, last);
    for (; i < end; ++i) {
        if (!both_hold_samples(i)) continue;
        const Half &a = halves_[2 * i], &b = halves_[2 * i + 1];
        const double na = double(a.count), nb = double(b.count);
        const Vec3d around = surroundings.mean(int(i % size_t(width_)), int(i / size_t(width_)));
        error.add({a.r / na, a.g / na, a.b / na}, {b.r / nb, b.g / nb, b.b / nb}, na * weights(a, b).a, around);
    }
    return error;
}

void Film::resolve(Frame& frame, const Workers& workers) const {
    const size_t n = size_t(width_) * size_t(height_);
    frame.width = width_;
    frame.height = height_;
    frame.rgba.resize(4 * n);
    frame.pixel_samples.resize(adaptive_ ? n : 0);
    frame.albedo.resize(planes_.albedo ? n : 0);
    frame.normal.resize(planes_.normal ? n : 0);
    frame.depth.resize(planes_.depth ? n : 0);
    frame.object_id.resize(planes_.ids ? n : 0);
    frame.material_id.resize(planes_.ids ? n : 0);
    frame.bounces.resize(size_t(planes_.bounces));
    for (std::vector<Vec3>& plane : frame.bounces) plane.resize(n);
    frame.health = health_;

    // Bands of a fixed size, summed in order: the estimate does not depend on threads.
    constexpr int band = 32;
    std::vector<ErrorAccumulator> errors(size_t((height_ + band - 1) / band));
    const auto for_each_band = [&](const auto& task) {
        workers.for_each(int64_t(errors.size()), {}, [&](int64_t i, unsigned) { task(size_t(i), int(i) * band, std::min(height_, int(i + 1) * band)); });
    };
    for_each_band([&](size_t, int first, int last) { resolve_rows(frame, first, last); });
    for_each_band([&](size_t i, int first, int last) { errors[i] = error_of_rows(frame, first, last); });
    ErrorAccumulator error;
    for (const ErrorAccumulator& e : errors) error.merge(e);
    frame.error = error.estimate();
}

std::vector<Vec3> Film::standard_error() const {
    const size_t n = size_t(width_) * size_t(height_);
    std::vector<Vec3> result;
    result.reserve(n);
    for (size_t i = 0; i < n; ++i) {
        const Half &a = halves_[2 * i], &b = halves_[2 * i + 1];
        if (a.count == 0 || b.count == 0) return {};
        const double na = double(a.count), nb = double(b.count);
        // |A - B| times the factor that makes its square an unbiased estimate of the variance of the weighted mean.
        const Weights w = weights(a, b);
        const double k = std::sqrt(na * w.a * nb * w.b);
        result.push_back(
            {float(std::abs(a.r / na - b.r / nb) * k), float(std::abs(a.g / na - b.g / nb) * k), float(std::abs(a.b / na - b.b / nb) * k)});
    }
    return result;
}

} // namespace blush
