#include "render/film/splat_planes.h"

#include "core/math.h"

#include <algorithm>

namespace blush {

void SplatPlanes::Split::reset(size_t pixels, int planes) {
    count = pixels > 0 ? planes : 0;
    sums.assign(2 * pixels * size_t(planes), {});
}

// Of planes that do not exist, nothing.
void SplatPlanes::Split::add(size_t pixel, int half, size_t plane, const Vec3d& radiance) {
    if (count == 0) return;
    sums[place(pixel, half) + std::min(plane, size_t(count) - 1)].add(radiance);
}

void SplatPlanes::reset(size_t pixels, int bounces, int groups) {
    sums_.assign(2 * pixels, {});
    by_bounce_.reset(pixels, bounces);
    by_group_.reset(pixels, groups);
    passes_ = {};
    missing_ = {};
}

std::vector<BadSample> SplatPlanes::add_pass(int64_t pass, std::span<const std::span<const Splat>> tiles, int width, uint32_t seed,
                                             const Workers& workers, double traced) {
    const int half = int(pass & 1);
    const int64_t pixels = int64_t(sums_.size() / 2), bands = int64_t(workers.threads());
    std::vector<std::vector<BadSample>> dropped(size_t(bands), std::vector<BadSample>{});
    // Each band looks at all splats and adds its own: most of the time goes into the memory of the sums.
    workers.for_each(bands, {}, [&](int64_t band, unsigned) {
        const int64_t first = pixels * band / bands, last = pixels * (band + 1) / bands;
        for (const std::span<const Splat> tile : tiles)
            for (const Splat& splat : tile) {
                if (splat.pixel < first || splat.pixel >= last) continue;
                const Vec3d radiance{double(splat.radiance.x), double(splat.radiance.y), double(splat.radiance.z)};
                if (const auto cause = cause_to_drop(radiance)) {
                    // The first kinds are the causes.
                    const Fault fault{Fault::Kind(*cause), Fault::Place::light_path, 0};
                    dropped[size_t(band)].push_back({*cause, splat.pixel % width, splat.pixel / width, pass, seed, fault});
                    continue;
                }
                sum(size_t(splat.pixel), half).add(radiance);
                by_bounce_.add(size_t(splat.pixel), half, splat.scatterings, radiance);
                by_group_.add(size_t(splat.pixel), half, splat.group, radiance);
            }
    });
    if (missing_[size_t(half)] == 0) ++passes_[size_t(half)];
    missing_[size_t(half)] = 1 - traced;
    std::vector<BadSample> all;
    for (const std::vector<BadSample>& of_band : dropped) all.insert(all.end(), of_band.begin(), of_band.end());
    return all;
}

} // namespace blush
