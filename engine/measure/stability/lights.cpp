// Stability cases of lights: all sizes and intensities above a diffuse floor, against closed forms.
#include "core/math.h"
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush::stability {
namespace {

Light light_of(Light::Kind kind, float intensity) {
    Light light;
    light.kind = kind;
    light.intensity = intensity;
    return light;
}
Light square(float side, float nits) {
    Light light = light_of(Light::Kind::rectangle, nits);
    light.width = light.height = side;
    return light;
}
FloorIrradiance of_point(const Vec3d& p, double candela) {
    return [=](const Vec3d& x) {
        const Vec3d to = p - x;
        return candela * to.y / std::pow(length(to), 3);
    };
}

Findings area_light(const Light& light, const Transform& pose) {
    Scene scene;
    place_light(scene, light, pose);
    const auto corners = rectangle_corners(light, pose);
    return quarters(scene, [&](const Vec3d& x) { return double(light.intensity) * polygon_irradiance(x, up, corners); });
}
const Transform overhead = aimed({0, 1, 0}, {0, -1, 0});

Findings candle(float candela, float height) {
    Scene scene;
    place_light(scene, light_of(Light::Kind::point, candela), at({0, height, 0}));
    return quarters(scene, of_point({0, double(height), 0}, double(candela)));
}

Findings ball(float radius) {
    Scene scene;
    Light light = light_of(Light::Kind::point, 5);
    light.radius = radius;
    place_light(scene, light, at({0, 2, 0}));
    return quarters(scene, of_point({0, 2, 0}, 5));
}

Findings sun(float angle) {
    Scene scene;
    Light light = light_of(Light::Kind::sun, 7);
    light.angle_radians = angle;
    const Transform pose = aimed({0, 0, 0}, {1, -1, 0.5f});
    place_light(scene, light, pose);
    const double cos = to_affine(pose.rotation).z.y;
    return quarters(scene, [cos](const Vec3d&) { return 7 * cos; });
}

// Two black plates at height 1, `width` apart, below an area light of 2 x 2 at height 2: a floor point sees a strip of the light.
Findings slit(float width, int64_t spp) {
    Scene scene;
    const Light light = square(2, 100);
    place_light(scene, light, aimed({0, 2, 0}, {0, -1, 0}));
    const float w = width / 2;
    place(scene, quad({-60, 1, 60}, {-w, 1, 60}, {-w, 1, -60}, {-60, 1, -60}), lambert(0.f));
    place(scene, quad({w, 1, 60}, {60, 1, 60}, {60, 1, -60}, {w, 1, -60}), lambert(0.f));
    const auto through = [&](const Vec3d& x) {
        const double low = std::max(-1.0, -double(width) - x.x), high = std::min(1.0, double(width) - x.x);
        if (low >= high) return 0.0;
        const Vec3d strip[] = {{low, 2, -1}, {high, 2, -1}, {high, 2, 1}, {low, 2, 1}};
        return 100 * polygon_irradiance(x, up, strip);
    };
    return quarters(scene, through, settings_for(16, 16, spp));
}

// A roof blocks the sun; the candle has less than 1e-12 of the scene's power.
Findings candle_under_a_roof() {
    Scene scene;
    place(scene, floor_quad(1000, 3), lambert(0.f));
    place_light(scene, light_of(Light::Kind::sun, 1e5f), aimed({0, 0, 0}, {0.1f, -1, 0}));
    place_light(scene, light_of(Light::Kind::point, 1), at({0, 1, 0}));
    return quarters(scene, of_point({0, 1, 0}, 1), settings_for(16, 16, 1024));
}

// Only the weak area light illuminates the floor: the strong one faces away.
Findings strong_and_weak() {
    Scene scene;
    const Light weak = square(1, 1e-6f);
    place_light(scene, weak, overhead);
    place_light(scene, square(1, 1e12f), aimed({0, 1.5f, 0}, {0, 1, 0}));
    const auto corners = rectangle_corners(weak, overhead);
    return quarters(
        scene, [&](const Vec3d& x) { return 1e-6f * polygon_irradiance(x, up, corners); }, settings_for(16, 16, 256));
}

// At the edge of the floor, perpendicular to it.
Findings upright_area_light(float scale) {
    Light light = square(2 * scale, 3);
    return area_light(light, aimed({-1, scale, 0}, {1, 0, 0}));
}

} // namespace

std::vector<StabilityCase> light_cases() {
    std::vector<StabilityCase> cases;
    for (const float side : {1e-6f, 1e-4f, 1e-2f, 1.f, 1e2f, 1e4f, 1e6f})
        cases.push_back({fmt::format("area light {:g} m across", side), no_area, [side] { return area_light(square(side, 3), overhead); }});
    for (const float nits : {1e-6f, 1e-3f, 1e3f, 1e6f, 1e9f, 1e12f})
        cases.push_back(
            {fmt::format("area light of {:g} nits", nits), dynamic_range, [nits] { return area_light(square(1, nits), overhead); }});
    cases.push_back({"area light 1e-6 m across of 1e12 nits", no_area, [] { return area_light(square(1e-6f, 1e12f), overhead); }});
    cases.push_back({"area light 1e6 m across of 1e12 nits", dynamic_range, [] { return area_light(square(1e6f, 1e12f), overhead); }});
    cases.push_back({"area light 1e6 m across, 1e6 m away", no_area, [] {
                         return area_light(square(1e6f, 3), aimed({0, 1e6f, 0}, {0, -1, 0}));
                     }});
    for (const float scale : {0.5f, 100.f})
        cases.push_back({fmt::format("upright area light {:g} m high on the floor's edge", 2 * scale), shadow_ends,
                         [scale] { return upright_area_light(scale); }});
    for (const float radius : {1e-4f, 1e-2f, 0.5f})
        cases.push_back({fmt::format("ball of radius {:g} m", radius), small_angles, [radius] { return ball(radius); }});
    cases.push_back({"point of 1e-6 cd", dynamic_range, [] { return candle(1e-6f, 1); }});
    cases.push_back({"point of 1e12 cd, 1e6 m away", dynamic_range, [] { return candle(1e12f, 1e6f); }});
    for (const float angle : {0.f, 1e-6f, 1e-4f, 0.00925f})
        cases.push_back({fmt::format("sun of angle {:g}", angle), small_angles, [angle] { return sun(angle); }});
    cases.push_back({"area light seen through a slit of 20 mm", shadow_ends, [] { return slit(0.02f, 1024); }});
    cases.push_back({"area light seen through a slit of 2 mm", shadow_ends, [] { return slit(0.002f, 4096); }});
    cases.push_back({"candle under a roof, beside 1e5 lux", dynamic_range, candle_under_a_roof});
    cases.push_back({"area light of 1e-6 nits beside one of 1e12", dynamic_range, strong_and_weak});
    return cases;
}

} // namespace blush::stability
