// Stability cases of grazing light and view directions.
#include "core/math.h"
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"
#include "scene/affine.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace blush::stability {
namespace {

Vec3 skimming(double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    return {float(std::sin(a)), float(std::cos(a)), 0};
}

// A floor of albedo 0.8 under a parallel sun of 3 lux; uses the cosine of the rounded direction in the scene.
Findings sun_at(double degrees) {
    Scene scene;
    place(scene, floor_quad(1), lambert(0.8f));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 3;
    const Transform pose = aimed({0, 0, 0}, -skimming(degrees));
    place_light(scene, sun, pose);
    scene.view = looking_down(0.9f, 1);
    const double cos = to_affine(pose.rotation).z.y;
    return every_pixel(render(scene, settings_for(8, 8, 1)), double(0.8f) / std::numbers::pi * 3 * cos);
}

// An orthographic view of a floor from 5 m away.
View view_at(double degrees, float half_height) {
    View view = looking({0, 0, 0}, -skimming(degrees), 1);
    view.position = skimming(degrees) * 5.f;
    view.lens.orthographic = true;
    view.lens.ymag = half_height;
    return view;
}

// Black lacquer in a white environment shows only its Fresnel reflection: Schlick's approximation as in glTF, Appendix B.
Findings lacquer(double degrees) {
    Scene scene;
    Material black = plastic(0);
    black.base_color = {0, 0, 0};
    place(scene, floor_quad(100), black);
    constant_world(scene, 1);
    scene.view = view_at(degrees, float(std::cos(degrees * std::numbers::pi / 180)));
    const double cos = to_affine(scene.view.rotation).z.y;
    return every_pixel(render(scene, settings_for(8, 8, 2)), 0.04 + 0.96 * std::pow(1 - cos, 5));
}

Findings diffuse_floor(double degrees) {
    Scene scene;
    place(scene, floor_quad(100), lambert(0.8f));
    constant_world(scene, 1);
    scene.view = view_at(degrees, float(std::cos(degrees * std::numbers::pi / 180)));
    return whole(render(scene, settings_for(16, 16, 64)), double(0.8f));
}

} // namespace

std::vector<StabilityCase> grazing_cases() {
    std::vector<StabilityCase> cases;
    for (const double degrees : {80.0, 89.0, 89.9, 89.99, 89.9999}) {
        cases.push_back({fmt::format("sun at {} degrees", degrees), grazing_angles, [degrees] { return sun_at(degrees); }});
        cases.push_back({fmt::format("lacquer seen at {} degrees", degrees), grazing_angles, [degrees] { return lacquer(degrees); }});
    }
    cases.push_back({"diffuse floor seen at 89.9999 degrees", grazing_angles, [] { return diffuse_floor(89.9999); }});
    return cases;
}

} // namespace blush::stability
