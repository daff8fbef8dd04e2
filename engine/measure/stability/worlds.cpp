// Stability cases of environments: single bright texels, and suns in mirrors.
#include "core/math.h"
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace blush::stability {
namespace {

constexpr int columns = 32, rows = 16;

std::vector<Vec3> black_but_for(int column, int row, float background, float bright) {
    std::vector<Vec3> texels(size_t(columns) * rows, Vec3{background, background, background});
    texels[size_t(row) * columns + size_t(column)] = {bright, bright, bright};
    return texels;
}

// Irradiance of a floor by the bilinearly interpolated map (constant above the centres of the first row), by the midpoint rule
// with `steps` points along each side of a texel. The centre column looks along -Z, the top row along +Y.
double irradiance_of(const std::vector<Vec3>& texels, int steps) {
    const auto texel = [&](int c, int r) {
        return double(texels[size_t(std::clamp(r, 0, rows - 1)) * columns + size_t((c + columns) % columns)].x);
    };
    double sum = 0;
    for (int i = 0; i < rows * steps / 2; ++i) {
        const double y = (i + 0.5) / steps - 0.5, theta = std::numbers::pi * (y + 0.5) / rows;
        const int r = int(std::floor(y));
        for (int j = 0; j < columns * steps; ++j) {
            const double x = (j + 0.5) / steps - 0.5;
            const int c = int(std::floor(x));
            const double v = y - r, u = x - c;
            const double above = texel(c, r) * (1 - u) + texel(c + 1, r) * u, below = texel(c, r + 1) * (1 - u) + texel(c + 1, r + 1) * u;
            sum += (above * (1 - v) + below * v) * std::cos(theta) * std::sin(theta);
        }
    }
    return sum * (std::numbers::pi / (rows * steps)) * (2 * std::numbers::pi / (columns * steps));
}

Findings bright_texel(int column, int row, float background, float bright) {
    const std::vector<Vec3> texels = black_but_for(column, row, background, bright);
    Scene scene;
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = float_image(columns, rows, texels);
    const double coarse = irradiance_of(texels, 16), expected = irradiance_of(texels, 32);
    Findings all = quarters(scene, [&](const Vec3d&) { return expected; });
    // Error of the midpoint rule: a third of the change by the finer steps.
    for (Finding& f : all) f.rounding += std::abs(coarse - expected) / expected * f.expected;
    return all;
}

Findings constant(float nits) {
    Scene scene;
    constant_world(scene, nits);
    return quarters(scene, [&](const Vec3d&) { return std::numbers::pi * double(nits); });
}

// A mirror reflects the disk of a sun of the given angle: the mean of the image is lux over the solid angle of the pixels.
Findings sun_in_a_mirror(float angle) {
    Scene scene;
    place(scene, floor_quad(1), metal(0));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 5;
    sun.angle_radians = angle;
    place_light(scene, sun, aimed({0, 0, 0}, {0, -1, 0}));
    // Looks down from 1 m; the reflected disk covers about a quarter of the image.
    const float half = angle;
    scene.view = looking({0, 1, 0}, {0, 0, 0}, 2 * half);
    const RenderedImage image = render(scene, settings_for(32, 32, 64));
    // Area of the disk over that of the image, both on the plane at distance 1.
    const double radius = std::tan(double(angle) / 2), edge = 2 * std::tan(double(scene.view.lens.yfov_radians) / 2);
    const double radiance = 5 / (std::numbers::pi * std::pow(std::sin(double(angle) / 2), 2));
    return whole(image, radiance * std::numbers::pi * radius * radius / (edge * edge));
}

} // namespace

std::vector<StabilityCase> world_cases() {
    std::vector<StabilityCase> cases;
    cases.push_back({"one texel a million times brighter", importance_maps, [] { return bright_texel(20, 4, 1, 1e6f); }});
    cases.push_back({"one texel a million times brighter, at the pole", importance_maps, [] { return bright_texel(3, 0, 1, 1e6f); }});
    cases.push_back({"one texel a million times brighter, on the seam", importance_maps, [] { return bright_texel(0, 5, 1, 1e6f); }});
    cases.push_back({"one texel in a black world", importance_maps, [] { return bright_texel(7, 3, 0, 1e12f); }});
    cases.push_back({"one texel at the horizon", importance_maps, [] { return bright_texel(25, 7, 1e-3f, 1e3f); }});
    for (const float nits : {1e-30f, 1.f, 1e30f})
        cases.push_back({fmt::format("constant world of {:g} nits", nits), densities, [nits] { return constant(nits); }});
    for (const float angle : {0.1f, 1e-2f, 1e-3f})
        cases.push_back({fmt::format("sun of angle {:g} in a mirror", angle), densities, [angle] { return sun_in_a_mirror(angle); }});
    return cases;
}

} // namespace blush::stability
