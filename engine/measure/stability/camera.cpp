// Stability cases of cameras: extreme positions, fields of view, apertures and image sizes.
#include "core/math.h"
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace blush::stability {
namespace {

// An emissive square that covers a quarter of a square image at any field of view.
Findings quarter_of_the_view(double degrees, float distance) {
    Scene scene;
    scene.view = looking({0, 0, 0}, {0, 0, -1}, float(degrees * std::numbers::pi / 180));
    const float half = float(0.5 * double(distance) * std::tan(double(scene.view.lens.yfov_radians) / 2));
    place(scene, quad({-half, -half, -distance}, {half, -half, -distance}, {half, half, -distance}, {-half, half, -distance}), emitter(1));
    const double edge = double(half) / (double(distance) * std::tan(double(scene.view.lens.yfov_radians) / 2));
    // The size of the square is rounded to single precision.
    return whole(render(scene, settings_for(18, 18, 64)), edge * edge, 0x1p-22);
}

// A plane that contains the camera is invisible and does not occlude what is behind it.
Findings on_a_floor(const Vec3& direction) {
    Scene scene;
    place(scene, floor_quad(10), lambert(0.5f));
    constant_world(scene, 1);
    place(scene, ceiling_quad(100, 1), emitter(3));
    place(scene, floor_quad(100, -1), emitter(2));
    scene.view = looking({0.3f, 0, 0.2f}, Vec3{0.3f, 0, 0.2f} + direction, 0.5f);
    return every_pixel(render(scene, settings_for(8, 8, 4)), direction.y > 0 ? 3 : 2);
}

// A diffuse floor under the sun is lit evenly: every pixel has the same value at any image size.
Findings shape(int width, int height) {
    Scene scene;
    place(scene, floor_quad(1e5f), lambert(0.8f));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 3;
    place_light(scene, sun, aimed({0, 0, 0}, {0, -1, 0}));
    scene.view = looking_down(1, 1);
    const RenderedImage image = render(scene, settings_for(width, height, 1));
    const double expected = double(0.8f) * 3 / std::numbers::pi;
    Findings ends;
    for (const int x : {0, width / 2, width - 1}) ends.push_back({expected, image.at(x, height - 1).x, 0, 0, fmt::format("pixel {}", x)});
    const auto wrong = std::count_if(image.pixels.begin(), image.pixels.end(),
                                     [&](const Vec3d& p) { return !(std::abs(p.x - expected) <= float_rounding * expected); });
    ends.push_back(count_of(double(wrong), "pixels that differ"));
    return ends;
}

// An edge in the focal plane is sharp at any aperture.
Findings lens(float aperture) {
    Scene scene;
    place(scene, ceiling_quad(1, 4), emitter(1), at({-1, 0, 0}));
    scene.view = looking({0, 0, 0}, {0, 1, 0}, 0.2f);
    scene.view.lens.aperture_radius = aperture;
    scene.view.lens.focus_distance = 4;
    const RenderedImage image = render(scene, settings_for(16, 16, 64));
    Findings halves;
    // The edge is between rows 8 and 9: rounding may move a sample across it.
    halves.push_back(compare(image.region(0, 0, 16, 7), 1));
    halves.push_back(compare(image.region(0, 9, 16, 7), 0));
    return halves;
}

} // namespace

std::vector<StabilityCase> camera_cases() {
    std::vector<StabilityCase> cases;
    for (const double degrees : {1e-4, 1.0, 90.0, 170.0, 179.0})
        cases.push_back({fmt::format("{:g} degrees of view", degrees), scales, [degrees] { return quarter_of_the_view(degrees, 1); }});
    cases.push_back({"1e-4 degrees of view, 1e6 m away", scales, [] { return quarter_of_the_view(1e-4, 1e6f); }});
    cases.push_back({"179 degrees of view, 1e-6 m away", scales, [] { return quarter_of_the_view(179, 1e-6f); }});
    for (const Vec3& direction : {Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{1, 0.4f, 0.2f}, Vec3{1, -0.4f, 0.2f}})
        cases.push_back({fmt::format("eye on a surface, looking along ({:g}, {:g}, {:g})", direction.x, direction.y, direction.z),
                         leaving_surfaces, [direction] { return on_a_floor(direction); }});
    cases.push_back({"image of 1 x 1", output_range, [] { return shape(1, 1); }});
    cases.push_back({"image of 16384 x 1", output_range, [] { return shape(16384, 1); }});
    cases.push_back({"image of 1 x 4096", output_range, [] { return shape(1, 4096); }});
    for (const float aperture : {1e-6f, 0.1f, 2.f})
        cases.push_back({fmt::format("lens of radius {:g} m", aperture), scales, [aperture] { return lens(aperture); }});
    return cases;
}

} // namespace blush::stability
