// Stability cases of absorption: from almost clear to almost black solids, 1e8 m to 1e-9 m thick.
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"

#include <cmath>
#include <fmt/format.h>

namespace blush::stability {
namespace {

// A slab without refraction, viewed perpendicularly in an environment of radiance 1: exp(-depth per_metre) (Beer-Lambert).
Findings slab(float per_metre, float depth) {
    Scene scene;
    Material solid = glass(0, 1);
    const float color = std::exp(-1.f);
    solid.attenuation_color = {color, color, color};
    solid.attenuation_distance = 1 / per_metre;
    Transform shape;
    shape.scale = {2 * depth, depth / 2, 2 * depth};
    place(scene, cube(false), solid, shape);
    constant_world(scene, 1);
    scene.view = looking_down(depth, 2 * depth);
    const double exponent = -std::log(double(color)) / double(solid.attenuation_distance) * double(depth);
    const double expected = std::exp(-exponent);
    // The relative error of the result is that of the exponent times the exponent.
    return every_pixel(render(scene, settings_for(8, 8, 2)), expected, float_rounding * exponent * expected);
}

// Interreflection within an absorbing pane of glass: reflection plus transmission in a white environment.
Findings pane(float passage) {
    Scene scene;
    Material solid = glass(0, 1.5f);
    solid.attenuation_color = {passage, passage, passage};
    solid.attenuation_distance = 0.8f;
    Transform shape;
    shape.scale = {2, 0.4f, 2};
    place(scene, cube(false), solid, shape);
    constant_world(scene, 1);
    scene.view = looking_down(1, 3);
    const double r = 0.04, p = double(passage), inside = (1 - r) * (1 - r) / (1 - r * r * p * p);
    return whole(render(scene, settings_for(16, 16, 64)), r + r * inside * p * p + inside * p);
}

} // namespace

std::vector<StabilityCase> absorption_cases() {
    struct Slab {
        float per_metre, depth;
    };
    constexpr Slab slabs[] = {{1e-9f, 1},    {1e-9f, 1e8f}, {1e-6f, 1e6f}, {1e-3f, 1}, {1, 1}, {1e3f, 1e-3f},
                              {1e6f, 1e-6f}, {1e9f, 1e-9f}, {1e9f, 1},     {30, 1},    {1, 80}};
    std::vector<StabilityCase> cases;
    for (const Slab& s : slabs)
        cases.push_back({fmt::format("{:g} per metre, {:g} m deep", s.per_metre, s.depth),
                         s.per_metre * s.depth > 10 ? output_range : nested_solids, [s] { return slab(s.per_metre, s.depth); }});
    for (const float passage : {1.f, 0.25f, 1e-6f})
        cases.push_back({fmt::format("pane that passes {:g} each way", passage), nested_solids, [passage] { return pane(passage); }});
    return cases;
}

} // namespace blush::stability
