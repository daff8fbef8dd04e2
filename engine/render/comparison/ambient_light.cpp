#include "render/comparison/ambient_light.h"

#include "core/sampling.h"
#include "render/integrator/wavefront.h"
#include "scene/affine.h"

#include <algorithm>
#include <numbers>

namespace blush {
namespace {

// Of the sampler: the kernels use those of the first scattering for direct light.
constexpr uint32_t occlusion_dimension = first_scatter_dimension + dimensions_per_scatter;
constexpr int points_across = 16, rays_per_point = 64; // of the automatic colour

} // namespace

// The constant with which the picture receives as much indirect light as it should: the mean irradiance over pi.
bool AmbientLight::prepare(const PreparationContext& context) {
    if (!options_.automatic_color) return true;
    const int width = int(context.kernel.settings.width), height = int(context.kernel.settings.height);
    struct Mean {
        Vec3d sum{0, 0, 0};
        int count = 0;
    };
    std::vector<Mean> rows(points_across);
    const bool done = context.workers.for_each(points_across, context.wanted, [&](int64_t row, unsigned worker) {
        TileScratch& scratch = context.scratch_of(worker);
        std::vector<DiffusePoint> points;
        for (int column = 0; column < points_across; ++column) {
            find_diffuse_points(context.kernel,
                                {.x = width * column / points_across, .y = int(height * row / points_across), .width = 1, .height = 1},
                                scratch, points);
            if (points.empty()) continue;
            const auto replicate = uint32_t(row * points_across + column);
            rows[size_t(row)].sum = rows[size_t(row)].sum +
                                    gather_indirect(context.kernel, points[0].receiver, replicate, rays_per_point, scratch).irradiance();
            ++rows[size_t(row)].count;
        }
    });
    Mean mean;
    for (const Mean& row : rows) mean = {mean.sum + row.sum, mean.count + row.count};
    color_ = to_float(mean.sum * (std::numbers::inv_pi / std::max(1, mean.count)));
    return done;
}

void AmbientLight::irradiance(const KernelContext& context, std::span<const DiffusePoint> points, TileScratch& scratch,
                              std::span<Vec3d> out) const {
    ShadowQueue& q = scratch.shadows;
    q.size = 0;
    for (const DiffusePoint& point : points) {
        const Pair<float> u = point.sampler.pair(occlusion_dimension);
        Step<float> step{};
        const Vec3 local = sample_cosine_hemisphere<float>(u.x(), u.y());
        step.shadow = {point.receiver.position, normalize(basis_around(point.receiver.normal).to_world(local))};
        step.shadow_distance = options_.distance;
        q.mask[q.size] = other_ray_mask;
        append<float>(q, step, point.slot, true);
    }
    context.accel->occluded(shadow_rays_of(context, q), q.size, false, scratch.blocked);
    const Vec3d open = to_double(color_) * std::numbers::pi;
    for (size_t i = 0; i < points.size(); ++i) out[i] = scratch.blocked[i] ? Vec3d{0, 0, 0} : open;
}

} // namespace blush
