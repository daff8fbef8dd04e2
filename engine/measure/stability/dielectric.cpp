// Stability cases of dielectrics: index of refraction 1 to 2.5, the critical angle, fifty interfaces.
#include "core/math.h"
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"
#include "scene/affine.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace blush::stability {
namespace {

// Fresnel reflectance for unpolarised light at an interface of index ratio eta.
double fresnel(double eta, double cos) {
    const double sin2 = (1 - cos * cos) / (eta * eta);
    if (sin2 >= 1) return 1;
    const double t = std::sqrt(1 - sin2), s = (cos - eta * t) / (cos + eta * t), p = (eta * cos - t) / (eta * cos + t);
    return 0.5 * (s * s + p * p);
}

Transform box(const Vec3& middle, const Vec3& half) {
    Transform t = at(middle);
    t.scale = half;
    return t;
}

Vec3 tilted(double degrees, double side) {
    const double a = degrees * std::numbers::pi / 180;
    return {float(std::sin(a)), float(side * std::cos(a)), 0};
}

// ---- white furnaces

Findings ball_in_furnace(const Material& material) {
    Scene scene;
    place(scene, sphere(false), material);
    constant_world(scene, 1);
    scene.view = looking({0.4f, 1.1f, 3}, {0, 0, 0}, 0.4f);
    return whole(render(scene, settings_for(16, 16, 64)), 1);
}

// Nested shells of glass with parallel facets.
Findings shells_in_furnace(int shells) {
    Scene scene;
    const Material material = glass(0, 1.5f);
    for (int i = 0; i < shells; ++i) {
        const float outer = 1 - 0.03f * float(i);
        place(scene, sphere(false), material, at({0, 0, 0}, outer));
        place(scene, sphere(true), material, at({0, 0, 0}, outer - 0.01f));
    }
    constant_world(scene, 1);
    scene.view = looking({0.4f, 1.1f, 3}, {0, 0, 0}, 0.4f);
    return whole(render(scene, settings_for(16, 16, 32)), 1);
}

// A camera within glass sees the environment n^2 times as bright.
Findings within_glass(float ior) {
    Scene scene;
    place(scene, cube(false), glass(0, ior), box({0, 0, 0}, {100, 1, 100}));
    constant_world(scene, 1);
    scene.view = looking({0, 0, 0}, tilted(10, 1), 0.2f);
    return whole(render(scene, settings_for(16, 16, 64)), double(ior) * double(ior));
}

// ---- panes before a bright floor

// Transmittance of n interfaces of reflectance r without interference: (1 - r) / (1 + (n - 1) r).
double through(int interfaces, double r) { return (1 - r) / (1 + (interfaces - 1) * r); }

Scene panes(int count, float ior, const View& view) {
    Scene scene;
    for (int i = 0; i < count; ++i) place(scene, cube(false), glass(0, ior), box({0, -0.05f - 0.2f * float(i), 0}, {50, 0.05f, 50}));
    place(scene, floor_quad(1e5f, -0.2f * float(count) - 1), emitter(1));
    scene.view = view;
    return scene;
}

Findings pane_at(float ior, double degrees) {
    View view = looking({0, 0, 0}, -tilted(degrees, 1), 1);
    view.position = tilted(degrees, 1) * 5.f;
    view.lens.orthographic = true;
    view.lens.ymag = 0.5f * view.position.y;
    const double cos = to_affine(view.rotation).z.y;
    return whole(render(panes(1, ior, view), settings_for(16, 16, 256)), through(2, fresnel(double(ior), cos)));
}

Findings stack_of_panes(int count) {
    return whole(render(panes(count, 1.5f, looking_down(1, 1)), settings_for(16, 16, 64)), through(2 * count, 0.04));
}

// ---- from within, above a black floor, near the critical angle

Findings beside_the_critical_angle(float ior, double off_degrees) {
    const double degrees = std::asin(1 / double(ior)) * 180 / std::numbers::pi + off_degrees;
    Scene scene;
    place(scene, cube(false), glass(0, ior), box({0, 0, 0}, {100, 1, 100}));
    place(scene, floor_quad(99, -0.5f), lambert(0.f));
    constant_world(scene, 1);
    scene.view = looking({0, 0, 0}, tilted(degrees, 1), 1);
    scene.view.lens.orthographic = true;
    scene.view.lens.ymag = 0.1f;
    const double n = double(ior), cos = -to_affine(scene.view.rotation).z.y;
    const auto seen = [&](double c) { return n * n * (1 - fresnel(1 / n, c)); };
    // The square root at the critical angle amplifies the rounding error of the cosine.
    const double rounding = std::abs(seen(cos + 0x1p-22) - seen(cos - 0x1p-22));
    return whole(render(scene, settings_for(16, 16, 128)), seen(cos), rounding);
}

// ---- lights without size

// A floor under a plate of glass and a parallel sun: no ray hits it, and no shadow ray passes the plate. Both faces together transmit
// (1 - F)^2; longer paths are cut off.
Findings sun_through_solid_glass() {
    constexpr double reflectance = 0.04, passes = (1 - reflectance) * (1 - reflectance);
    Scene scene;
    place(scene, floor_quad(0.9f), lambert(0.5f));
    place(scene, cube(false), glass(0, 1.5f), box({0, 1.1f, 0}, {1, 0.1f, 1}));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = float(std::numbers::pi);
    place_light(scene, sun, aimed({0, 5, 0}, {0, -1, 0}));
    scene.view = looking_down(0.5f, 0.5f);
    RenderSettings settings = settings_for(16, 16, 64);
    settings.max_bounces = 3;
    return whole(render_anything(scene, settings), 0.5 * passes);
}

// The floor beside a block of glass that reflects once all that enters its top: what passes two faces comes to the floor from the other
// side. Light paths end in the mirror; manifold sampling finds it.
Findings sun_totally_reflected_in_glass() {
    constexpr double ior = 1.5, cosine = std::numbers::sqrt2 / 2;
    const double sine_inside = cosine / ior, wide = sine_inside / std::sqrt(1 - sine_inside * sine_inside); // per metre of height
    Scene scene = sunlit_floor_in_a_mirror();
    place(scene, cube(false), glass(0, float(ior)), box({0, 1.6f, 0}, {float(wide / 2), 0.5f, 5}));
    RenderSettings settings = settings_for(16, 16, 64);
    settings.max_bounces = 5;
    const double passes = 1 - fresnel(ior, cosine);
    return whole(render_anything(scene, settings), 0.01 * (1 + passes * passes));
}

} // namespace

std::vector<StabilityCase> dielectric_cases() {
    std::vector<StabilityCase> cases;
    for (const float ior : {1.f, 1 + 1e-6f, 1.001f, 1.5f, 2.5f})
        cases.push_back(
            {fmt::format("ball of ior {:.7g} in a furnace", ior), towards_vacuum, [ior] { return ball_in_furnace(glass(0, ior)); }});
    for (const float ior : {1.f, 1 + 1e-6f})
        cases.push_back({fmt::format("rough ball of ior {:.7g} in a furnace", ior), towards_vacuum,
                         [ior] { return ball_in_furnace(glass(0.5f, ior)); }});
    for (const float ior : {1.001f, 1.5f, 2.5f})
        for (const double degrees : {0.0, 45.0, 80.0, 89.0, 89.9})
            cases.push_back({fmt::format("pane of ior {} at {} degrees", ior, degrees), critical_angle,
                             [ior, degrees] { return pane_at(ior, degrees); }});
    for (const double off : {-1.0, -1e-2, -1e-4, 0.0, 1e-4, 1e-2})
        cases.push_back({fmt::format("{:g} degrees off the critical angle", off), critical_angle,
                         [off] { return beside_the_critical_angle(1.5f, off); }});
    for (const float ior : {1.001f, 1.5f, 2.5f})
        cases.push_back({fmt::format("camera within glass of ior {}", ior), nested_solids, [ior] { return within_glass(ior); }});
    cases.push_back({"50 interfaces, one behind another", nested_solids, [] { return stack_of_panes(25); }});
    cases.push_back({"50 interfaces around each other in a furnace", nested_solids, [] { return shells_in_furnace(25); }});
    cases.push_back({"floor under solid glass and a parallel sun", densities, sun_through_solid_glass});
    cases.push_back(
        {"parallel sun totally reflected in glass onto a floor that a mirror shows", densities, sun_totally_reflected_in_glass});
    return cases;
}

} // namespace blush::stability
