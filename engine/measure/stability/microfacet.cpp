// Stability cases of microfacet BSDFs: from roughness below single precision to the maximum.
#include "core/math.h"
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace blush::stability {
namespace {

float roughness_of(double alpha) { return float(std::sqrt(alpha)); }

double masking(double alpha, const Vec3d& w) {
    const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    return 2 / (1 + std::sqrt(1 + alpha * alpha * tan2));
}

// Directional albedo of a white metal in a constant environment: masking of the reflected direction, averaged over visible
// normals (Heitz 2018) by the midpoint rule.
double directional_albedo(double alpha, double cos) {
    const Vec3d wo{std::sqrt(1 - cos * cos), 0, cos};
    const Vec3d o = normalize(Vec3d{alpha * wo.x, alpha * wo.y, wo.z});
    const double l2 = o.x * o.x + o.y * o.y;
    const Vec3d s = l2 > 0 ? Vec3d{-o.y, o.x, 0} / std::sqrt(l2) : Vec3d{1, 0, 0}, t = cross(o, s);
    constexpr int steps = 512;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double r = std::sqrt((i + 0.5) / steps), phi = 2 * std::numbers::pi * (j + 0.5) / steps;
            const double a = r * std::cos(phi), squeeze = 0.5 * (1 + o.z);
            const double b = (1 - squeeze) * std::sqrt(1 - a * a) + squeeze * r * std::sin(phi);
            const Vec3d n = s * a + t * b + o * std::sqrt(std::max(0.0, 1 - a * a - b * b));
            const Vec3d h = normalize(Vec3d{alpha * n.x, alpha * n.y, std::max(0.0, n.z)});
            const Vec3d wi = h * (2 * dot(wo, h)) - wo;
            if (wi.z > 0) sum += masking(alpha, wi);
        }
    return sum / (steps * steps);
}

View parallel_view(double degrees, float half_height) {
    const double a = degrees * std::numbers::pi / 180;
    View view = looking({float(5 * std::sin(a)), float(5 * std::cos(a)), 0}, {0, 0, 0}, 1);
    view.lens.orthographic = true;
    view.lens.ymag = half_height;
    return view;
}

Findings white_metal(double alpha, double degrees) {
    Scene scene;
    place(scene, floor_quad(100), metal(roughness_of(alpha)));
    constant_world(scene, 1);
    scene.view = parallel_view(degrees, 0.3f);
    // Error of the midpoint rule at the discontinuity at the horizon: 1 / steps of the part that is cut off.
    return whole(render(scene, settings_for(16, 16, 256)), directional_albedo(alpha, std::cos(degrees * std::numbers::pi / 180)), 1e-4);
}

// An emissive wall whose reflected edge is at the centre of the image: half of the light is visible under any symmetric blur of
// the edge.
Findings edge_in_a_mirror(double alpha) {
    Scene scene;
    place(scene, floor_quad(10), metal(roughness_of(alpha)));
    place(scene, quad({-3, 0, 50}, {-3, 0, -50}, {-3, 3, -50}, {-3, 3, 50}), emitter(1));
    scene.view = parallel_view(45, 0.5f);
    // Masking and asymmetry of a lobe of width alpha are of second order.
    return whole(render(scene, settings_for(16, 16, 256)), 0.5, 4 * alpha * alpha);
}

// A light of 1 mm in an almost smooth mirror: found by both sampling strategies, counted once.
Findings light_in_a_mirror(double alpha, Strategy strategy) {
    Scene scene;
    place(scene, floor_quad(10), metal(roughness_of(alpha)));
    place(scene, ceiling_quad(5e-4f, 1), emitter(1e6f));
    scene.view = looking({0, 0.5f, 0}, {0, 0, 0}, 0.01f);
    RenderSettings settings = settings_for(32, 32, 256);
    settings.strategy = strategy;
    const RenderedImage blurred = render(scene, settings);
    // Its image in a perfect mirror: a square of 1 mm, 1.5 m away.
    const double edge = 2 * std::tan(double(scene.view.lens.yfov_radians) / 2) * 1.5;
    return whole(blurred, 1e6 * 1e-6 / (edge * edge), 4 * alpha * alpha);
}

} // namespace

std::vector<StabilityCase> microfacet_cases() {
    std::vector<StabilityCase> cases;
    for (const double alpha : {1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 1.0})
        for (const double degrees : {60.0, 85.0})
            cases.push_back({fmt::format("white metal of alpha {:g} at {} degrees", alpha, degrees), alpha < 1e-2 ? smooth_limit : frames,
                             [alpha, degrees] { return white_metal(alpha, degrees); }});
    // On both sides of the roughness threshold of a delta lobe.
    for (const double alpha : {1e-5, 0.99e-4, 1.01e-4, 1e-3})
        cases.push_back(
            {fmt::format("edge of light in a metal of alpha {:g}", alpha), smooth_limit, [alpha] { return edge_in_a_mirror(alpha); }});
    for (const double alpha : {0.99e-4, 1.01e-4, 3e-4})
        cases.push_back({fmt::format("light in a metal of alpha {:g}", alpha), smooth_limit,
                         [alpha] { return light_in_a_mirror(alpha, Strategy::mis); }});
    cases.push_back(
        {"light in a metal of alpha 0.0003, BSDF sampling alone", smooth_limit, [] { return light_in_a_mirror(3e-4, Strategy::bsdf); }});
    return cases;
}

} // namespace blush::stability
