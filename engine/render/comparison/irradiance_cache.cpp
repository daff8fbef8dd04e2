#include "render/comparison/irradiance_cache.h"

#include "render/comparison/cells.h"
#include "render/comparison/irradiance_gradient.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

constexpr int first_stride = 32; // pixels between the points of the first level
constexpr int fallback_rays = 16;
constexpr uint32_t fallback_replicate = 0x80000000u; // apart from those of records

} // namespace

Vec3d IrradianceRecord::irradiance(const Vec3d& at, const Vec3d& n) const {
    const Vec3d to = at - position;
    const auto channel = [&](size_t k) { return std::max(0.0, dot(flux[k], n) + dot(gradient[k], to)); };
    return {channel(0), channel(1), channel(2)};
}

double IrradianceRecord::weight(const Vec3d& at, const Vec3d& n) const {
    const Vec3d to = at - position;
    if (dot(to, n + normal) < -0.1 * radius) return 0; // Ward 1988: such a record sees other surfaces
    const double error = length(to) / radius + std::sqrt(std::max(0.0, 1 - dot(n, normal)));
    return 1 / std::max(error, 1e-9);
}

IrradianceCache::Interpolated IrradianceCache::interpolate(const DiffusePoint& point) const {
    Interpolated result;
    const Vec3d at = to_double(point.receiver.position), normal = to_double(point.receiver.normal);
    for (const auto& [exponent, cells] : levels_) {
        const double size = std::ldexp(1.0, exponent);
        for_each_cell_near(at, size, [&](uint64_t key) {
            const auto found = cells.find(key);
            if (found == cells.end()) return;
            for (const uint32_t i : found->second) {
                const double weight = records_[i].weight(at, normal);
                if (!(weight * double(options_.accuracy) > 1)) continue;
                result.weight += weight;
                result.sum = result.sum + records_[i].irradiance(at, normal) * weight;
            }
        });
    }
    return result;
}

bool IrradianceCache::is_covered(const DiffusePoint& point) const { return interpolate(point).weight > 0; }

IrradianceRecord IrradianceCache::measure(const KernelContext& context, const DiffusePoint& point, uint32_t replicate,
                                          TileScratch& scratch) const {
    const int count = options_.rays > 0 ? options_.rays : options_.default_rays();
    const GatheredRays rays = gather_indirect(context, point.receiver, replicate, count, scratch);
    IrradianceRecord record{.position = to_double(point.receiver.position), .normal = to_double(point.receiver.normal)};
    double inverse_distances = 0;
    for (size_t i = 0; i < rays.direction.size(); ++i) {
        const Vec3d d = to_double(rays.direction[i]);
        // Each path stands for pi / N of the cosine, which turns with the normal.
        const double per_cosine = std::numbers::pi / (double(count) * std::max(dot(d, record.normal), 1e-4));
        record.flux[0] = record.flux[0] + d * (rays.radiance[i].x * per_cosine);
        record.flux[1] = record.flux[1] + d * (rays.radiance[i].y * per_cosine);
        record.flux[2] = record.flux[2] + d * (rays.radiance[i].z * per_cosine);
        inverse_distances += 1 / std::max(double(rays.distance[i]), 1e-6 * extent_); // 0 for paths that leave the scene
    }
    const double radius = inverse_distances > 0 ? double(count) / inverse_distances : extent_;
    record.radius = std::clamp(radius, 1e-3 * extent_, 0.5 * extent_);
    record.gradient = translational_gradient(rays, point.receiver.normal, 1e-3 * extent_);
    return record;
}

void IrradianceCache::insert(const IrradianceRecord& record) {
    // Twice the reach, so that a point half a cell away from the corner of eight cells is reached from these alone.
    const double reach = std::max(2 * double(options_.accuracy) * record.radius, 1e-6 * extent_);
    int exponent = 0;
    std::frexp(reach, &exponent);
    levels_[exponent][cell_of(record.position, std::ldexp(1.0, exponent)).key()].push_back(uint32_t(records_.size()));
    records_.push_back(record);
}

// For those points that no record reaches.
bool IrradianceCache::add_records(const PreparationContext& context, const std::vector<DiffusePoint>& points) {
    constexpr int64_t batch = 64; // fixed, so that the records do not depend on threads
    std::vector<IrradianceRecord> made(batch);
    std::vector<uint8_t> needed(batch);
    for (int64_t begin = 0; begin < int64_t(points.size()); begin += batch) {
        const int64_t count = std::min<int64_t>(batch, int64_t(points.size()) - begin);
        const bool done = context.workers.for_each(count, context.wanted, [&](int64_t i, unsigned worker) {
            const DiffusePoint& point = points[size_t(begin + i)];
            needed[size_t(i)] = !is_covered(point);
            if (needed[size_t(i)]) made[size_t(i)] = measure(context.kernel, point, measured_ + uint32_t(i), context.scratch_of(worker));
        });
        if (!done) return false;
        measured_ += uint32_t(count);
        for (int64_t i = 0; i < count; ++i)
            if (needed[size_t(i)]) insert(made[size_t(i)]);
    }
    return true;
}

// From coarse to fine: each level fills the gaps of those before it.
bool IrradianceCache::prepare(const PreparationContext& context) {
    records_.clear();
    levels_.clear();
    measured_ = 0;
    extent_ = std::max(double(context.scene.radius), 1e-30);
    if (!(options_.accuracy > 0)) return true;
    const int width = int(context.kernel.settings.width), height = int(context.kernel.settings.height);
    for (int stride = first_stride; stride >= 1; stride /= 2) {
        const int rows = (height + stride - 1) / stride;
        std::vector<std::vector<DiffusePoint>> of_row;
        of_row.resize(size_t(rows));
        const bool found = context.workers.for_each(rows, context.wanted, [&](int64_t row, unsigned worker) {
            TileScratch& scratch = context.scratch_of(worker);
            std::vector<DiffusePoint> points;
            for (int x = 0; x < width; x += stride) {
                const bool seen = stride < first_stride && row % 2 == 0 && x / stride % 2 == 0; // by a coarser level
                if (seen) continue;
                find_diffuse_points(context.kernel, {.x = x, .y = int(row) * stride, .width = 1, .height = 1}, scratch, points);
                if (!points.empty() && !is_covered(points[0])) of_row[size_t(row)].push_back(points[0]);
            }
        });
        if (!found) return false;
        std::vector<DiffusePoint> points;
        for (const std::vector<DiffusePoint>& row : of_row) points.insert(points.end(), row.begin(), row.end());
        if (!add_records(context, points)) return false;
    }
    return true;
}

void IrradianceCache::irradiance(const KernelContext& context, std::span<const DiffusePoint> points, TileScratch& scratch,
                                 std::span<Vec3d> out) const {
    for (size_t i = 0; i < points.size(); ++i) {
        const Interpolated from_records = interpolate(points[i]);
        if (from_records.weight > 0) {
            out[i] = from_records.sum * (1 / from_records.weight);
            continue;
        }
        const uint32_t replicate = fallback_replicate | pcg_hash(points[i].sampler.key + pcg_hash(points[i].sampler.index));
        out[i] = gather_indirect(context, points[i].receiver, replicate, fallback_rays, scratch).irradiance();
    }
}

} // namespace blush
