#include "irradiance.h"

#include "core/math.h"

#include <numbers>

namespace blush::test {

double polygon_irradiance(const Vec3d& point, const Vec3d& n, std::span<const Vec3d> corners) {
    double sum = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = normalize(corners[i] - point), b = normalize(corners[(i + 1) % corners.size()] - point), c = cross(a, b);
        sum += std::atan2(length(c), dot(a, b)) * dot(normalize(c), n);
    }
    return std::abs(sum) / 2;
}

testing::AssertionResult shows_on_floor(Scene scene, const FloorIrradiance& irradiance, double alpha, RenderSettings settings) {
    constexpr float albedo = 0.6f;
    place(scene, floor_quad(50), lambert(albedo));
    scene.view = looking_down(1, 0.1f);
    const Picture picture = render(scene, settings);

    const int half = settings.width / 2;
    const std::vector<Measured> quarters = picture.blocks(half, half);
    for (int quarter = 0; quarter < 4; ++quarter) {
        // The midpoint rule, eight points along each side of a pixel.
        const int steps = 8 * half;
        double sum = 0;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j)
                sum += irradiance({(i + 0.5) / steps - (quarter % 2 == 0 ? 1 : 0), 0, (j + 0.5) / steps - (quarter / 2 == 0 ? 1 : 0)});
        const double expected = double(albedo) / std::numbers::pi * sum / (steps * steps);
        if (auto verdict = is_mean(quarters[size_t(quarter)], expected, statistics::sidak(alpha, 4)); !verdict)
            return verdict << ", quarter " << quarter;
    }
    return testing::AssertionSuccess();
}

} // namespace blush::test
