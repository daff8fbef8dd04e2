#include "render/comparison/light_probes.h"

#include "scene/affine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {

std::array<double, 9> spherical_harmonics(const Vec3d& d) {
    constexpr double c0 = 0.28209479177387814, c1 = 0.48860251190291992, c2 = 1.0925484305920792, c20 = 0.31539156525252005,
                     c22 = 0.54627421529603959;
    return {c0,
            c1 * d.y,
            c1 * d.z,
            c1 * d.x,
            c2 * d.x * d.y,
            c2 * d.y * d.z,
            c20 * (3 * d.z * d.z - 1),
            c2 * d.x * d.z,
            c22 * (d.x * d.x - d.y * d.y)};
}

Vec3d LightProbe::irradiance(const Vec3d& normal) const {
    constexpr double pi = std::numbers::pi, of_order[9] = {pi, 2 * pi / 3, 2 * pi / 3, 2 * pi / 3, pi / 4, pi / 4, pi / 4, pi / 4, pi / 4};
    const std::array<double, 9> y = spherical_harmonics(normal);
    Vec3d sum{0, 0, 0};
    for (size_t k = 0; k < 9; ++k) sum = sum + radiance[k] * (of_order[k] * y[k]);
    return {std::max(0.0, sum.x), std::max(0.0, sum.y), std::max(0.0, sum.z)};
}

// Six cosine lobes along the axes cover the sphere: their mixture has the density (|x| + |y| + |z|) / 6 pi, which is nowhere small.
LightProbe LightProbes::measure(const KernelContext& context, int64_t index, TileScratch& scratch) const {
    const int64_t n = side();
    const Vec3d at = corner_ + Vec3d{double(index % n), double(index / n % n), double(index / (n * n))} * cell_;
    const int total = options_.rays > 0 ? options_.rays : options_.default_rays(), per_lobe = (total + 5) / 6;
    LightProbe probe;
    for (int lobe = 0; lobe < 6; ++lobe) {
        const float sign = lobe % 2 ? -1.f : 1.f;
        const Vec3 axis = lobe < 2 ? Vec3{sign, 0, 0} : lobe < 4 ? Vec3{0, sign, 0} : Vec3{0, 0, sign};
        const GatheredRays rays = gather_indirect(context, {to_float(at), axis}, uint32_t(index * 6 + lobe), per_lobe, scratch);
        for (size_t i = 0; i < rays.direction.size(); ++i) {
            const Vec3d d = to_double(rays.direction[i]);
            const double pdf = (std::abs(d.x) + std::abs(d.y) + std::abs(d.z)) / (6 * std::numbers::pi);
            const std::array<double, 9> y = spherical_harmonics(d);
            for (size_t k = 0; k < 9; ++k) probe.radiance[k] = probe.radiance[k] + rays.radiance[i] * (y[k] / (pdf * 6 * per_lobe));
        }
    }
    return probe;
}

bool LightProbes::prepare(const PreparationContext& context) {
    const double radius = std::max(double(context.scene.radius), 1e-30);
    corner_ = to_double(context.scene.center) - Vec3d{radius, radius, radius};
    cell_ = 2 * radius / options_.grid;
    const int64_t count = int64_t(side()) * side() * side();
    probes_.assign(size_t(count), {});
    return context.workers.for_each(count, context.wanted, [&](int64_t i, unsigned worker) {
        probes_[size_t(i)] = measure(context.kernel, i, context.scratch_of(worker));
    });
}

void LightProbes::irradiance(const KernelContext&, std::span<const DiffusePoint> points, TileScratch&, std::span<Vec3d> out) const {
    const int n = side();
    for (size_t i = 0; i < points.size(); ++i) {
        const Vec3d at = (to_double(points[i].receiver.position) - corner_) * (1 / cell_), normal = to_double(points[i].receiver.normal);
        const auto cell = [&](double x) { return std::clamp(int(std::floor(x)), 0, options_.grid - 1); };
        const int cx = cell(at.x), cy = cell(at.y), cz = cell(at.z);
        Vec3d sum{0, 0, 0};
        for (int corner = 0; corner < 8; ++corner) {
            const int x = cx + (corner & 1), y = cy + (corner >> 1 & 1), z = cz + (corner >> 2);
            const auto near = [](double a, int b) { return std::max(0.0, 1 - std::abs(a - b)); };
            const double weight = near(at.x, x) * near(at.y, y) * near(at.z, z);
            if (weight > 0) sum = sum + probes_[size_t((z * n + y) * n + x)].irradiance(normal) * weight;
        }
        out[i] = sum;
    }
}

} // namespace blush
