// From connections of light paths to splats: the pixel that gets the light.
#pragma once

#include "core/sampler.h"
#include "render/integrator/camera.h"
#include "render/integrator/path_queues.h"

#include <algorithm>
#include <cmath>

namespace blush::inline BLUSH_ISA {

// A pixel along one axis, chosen for a position in proportion to the filter around each pixel's centre; `weight`: the sum of these filters.
struct SplatPixel {
    int pixel;
    float weight;
};
// `position` in pixels; u in [0, 1). The density of camera rays of a pixel (filter_offset) is constant between the table's entries.
inline SplatPixel splat_pixel(const FilterTable& filter, float position, float u) {
    const auto& offsets = filter.offset;
    const auto density = [&](float offset) {
        if (!(offset >= offsets.front() && offset < offsets.back())) return 0.f;
        const auto above = std::upper_bound(offsets.begin(), offsets.end() - 1, offset);
        return 1.f / (float(FilterTable::size) * (*above - *(above - 1)));
    };
    constexpr int most = 8;
    const int first = int(std::floor(position - 0.5f - offsets.back())), last = int(std::floor(position - 0.5f - offsets.front()));
    float sums[most];
    int count = 0;
    float sum = 0;
    for (int pixel = first; pixel <= last && count < most; ++pixel) sums[count++] = sum += density(position - 0.5f - float(pixel));
    if (!(sum > 0)) return {first, 0};
    int chosen = 0;
    while (chosen + 1 < count && u * sum >= sums[chosen]) ++chosen;
    return {first + chosen, sum};
}

// Adds the splat of connection k of the shadow queue.
inline void add_splat(const KernelContext& context, int bounce, TileScratch& scratch, int k) {
    const EstimatorSettings& settings = context.settings;
    const int32_t* groups = context.scene->groups.of_light;
    const ShadowQueue& q = scratch.shadows;
    LightPathColumns& columns = *scratch.light_paths;
    const EmittedPath& emitted = columns.emitted[size_t(q.slot[k])];
    const int image_width = int(settings.width), image_height = int(settings.height);
    // Any random numbers that the path has not used.
    const uint32_t random = pcg_hash(uint32_t(bounce) * 0x9e3779b9u ^ pcg_hash(columns.key ^ emitted.index));
    const SplatPixel x = splat_pixel(*settings.filter, columns.x[k], unit_float<float>(random));
    const SplatPixel y = splat_pixel(*settings.filter, columns.y[k], unit_float<float>(pcg_hash(random)));
    if (x.pixel < 0 || y.pixel < 0 || x.pixel >= image_width || y.pixel >= image_height || !(x.weight * y.weight > 0)) return;
    const int pixel = y.pixel * image_width + x.pixel;
    const Vec3 radiance = Vec3{q.r[k], q.g[k], q.b[k]} * (luminance(emitted.flux) * (x.weight * y.weight));
    columns.splats.push_back({pixel, radiance, uint16_t(std::min(bounce + 1, 65535)), uint16_t(groups ? groups[emitted.light] : 0)});
    if (!columns.measures) return;
    const float others = columns.others[k];
    columns.moments.push_back({pixel, luminance(radiance) * (1 + others * others), others}); // undoes the MIS weight (connect_vertex)
}

// Appends an emitted path to the queue.
inline void append_emitted(const EmittedPath& e, const Vec3& beta, uint32_t key, uint32_t index, int32_t slot, PathQueue& q) {
    const int i = q.size++;
    q.ox[i] = e.origin.x, q.oy[i] = e.origin.y, q.oz[i] = e.origin.z;
    q.dx[i] = e.direction.x, q.dy[i] = e.direction.y, q.dz[i] = e.direction.z;
    q.beta_r[i] = beta.x, q.beta_g[i] = beta.y, q.beta_b[i] = beta.z;
    q.pdf[i] = q.nx[i] = q.ny[i] = q.nz[i] = q.cone[i] = q.light_ratio[i] = q.emission_ratio[i] = 0;
    q.key[i] = key;
    q.index[i] = index;
    q.slot[i] = slot;
    q.part[i] = -1;
    q.dispersed[i] = 0;
    q.chain[i] = 0;
}

// Fills the queue with the emitted paths. Their throughput begins as the colour of the flux, at luminance 1, for Russian roulette.
inline void begin_light_paths(const LightPathColumns& columns, PathQueue& q) {
    q.size = 0;
    for (size_t k = 0; k < columns.emitted.size(); ++k) {
        const EmittedPath& e = columns.emitted[k];
        const float amount = luminance(e.flux);
        const Vec3 color = amount > 0 && e.density > 0 ? e.flux * (1 / amount) : Vec3{0, 0, 0};
        append_emitted(e, color, columns.key, e.index, int32_t(k), q);
    }
}

} // namespace blush::inline BLUSH_ISA
