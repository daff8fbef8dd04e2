#include "measure/stability/irradiance.h"

#include "core/math.h"

#include <cmath>
#include <numbers>

namespace blush::stability {

double polygon_irradiance(const Vec3d& point, const Vec3d& n, std::span<const Vec3d> corners) {
    double sum = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = normalize(corners[i] - point), b = normalize(corners[(i + 1) % corners.size()] - point), c = cross(a, b);
        sum += std::atan2(length(c), dot(a, b)) * dot(normalize(c), n);
    }
    return std::abs(sum) / 2;
}

std::array<Vec3d, 4> rectangle_corners(const Light& light, const Transform& transform) {
    const Affined world = to_affine(transform);
    const double w = 0.5 * double(light.width), h = 0.5 * double(light.height);
    return {transform_point(world, Vec3d{-w, -h, 0}), transform_point(world, Vec3d{w, -h, 0}), transform_point(world, Vec3d{w, h, 0}),
            transform_point(world, Vec3d{-w, h, 0})};
}

std::array<FloorQuarter, 4> photograph_floor(Scene scene, const FloorIrradiance& irradiance, const RenderSettings& settings) {
    constexpr float albedo = 0.6f;
    place(scene, floor_quad(50), lambert(albedo));
    scene.view = looking_down(1, 0.1f);
    const RenderedImage image = render(scene, settings);

    const int half = settings.width / 2;
    const std::vector<Measured> seen = image.blocks(half, half);
    std::array<FloorQuarter, 4> quarters;
    for (int quarter = 0; quarter < 4; ++quarter) {
        const int steps = 8 * half;
        double sum = 0;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j)
                sum += irradiance({(i + 0.5) / steps - (quarter % 2 == 0 ? 1 : 0), 0, (j + 0.5) / steps - (quarter / 2 == 0 ? 1 : 0)});
        quarters[size_t(quarter)] = {seen[size_t(quarter)], double(albedo) / std::numbers::pi * sum / (double(steps) * steps)};
    }
    return quarters;
}

} // namespace blush::stability
