// Stability cases of furnaces: constant environments and closed emissive rooms. A white object is invisible in a white furnace; a
// room of albedo rho has the radiance of a geometric series, with thousands of terms for rho close to 1.
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush::stability {
namespace {

constexpr float emission = 2;
// Maximum vertices of a path (render/integrator/estimator_settings.h limits it to 100000 scattering events).
constexpr double max_vertices = 100001;

Scene room(const GeometryPtr& walls, float albedo) {
    Scene scene;
    place(scene, walls, emitter(emission, albedo));
    scene.view = looking({0.1f, -0.2f, 0.3f}, {0.9f, 0.35f, -0.8f}, 1.2f);
    return scene;
}

// Le (1 + rho + rho^2 + ...) over a path's first `vertices`.
double series(float albedo, double vertices) {
    return double(emission) * -std::expm1(vertices * std::log(double(albedo))) / (1 - double(albedo));
}

// BSDF sampling only: all paths have the same value, so few samples suffice, and deviations are rounding errors. Their expected
// size is sqrt(n) times a single one (Higham and Mary 2019), n being the number of significant terms.
Findings without_roulette(const GeometryPtr& walls, float albedo) {
    RenderSettings settings = settings_for(4, 4, 1);
    settings.roulette.rule = Roulette::Rule::off;
    settings.strategy = Strategy::bsdf;
    const double expected = series(albedo, max_vertices), terms = std::min(max_vertices, 1 / (1 - double(albedo)));
    return every_pixel(render_anything(room(walls, albedo), settings), expected, 4 * std::sqrt(terms) * 0x1p-24 * expected);
}

Findings with_roulette(const GeometryPtr& walls, float albedo, const char* rule, int64_t spp) {
    RenderSettings settings = settings_for(16, 16, spp);
    settings.roulette = *parse_roulette(rule);
    return whole(render(room(walls, albedo), settings), series(albedo, INFINITY));
}

Findings white_furnace(const Material& material) {
    Scene scene;
    place(scene, sphere(false), material);
    constant_world(scene, 1);
    scene.view = looking({0.4f, 1.1f, 3}, {0, 0, 0}, 0.4f);
    return whole(render(scene, settings_for(16, 16, 64)), double(material.base_color.x));
}

// Samples with Russian roulette: fewer for longer paths.
struct Closed {
    float albedo;
    int64_t spp;
};
constexpr Closed closed[] = {{1 - 1e-4f, 16}, {0.999f, 32}, {0.99f, 64}, {0.9f, 64}, {0.5f, 64}};

} // namespace

std::vector<StabilityCase> furnace_cases() {
    std::vector<StabilityCase> cases;
    for (const Closed& c : closed)
        for (const auto& [shape, walls] : {std::pair{"sphere", sphere(true)}, {"cube", cube(true)}}) {
            const std::string what = fmt::format("closed {}, rho {:.4g}, roulette", shape, c.albedo);
            cases.push_back({what + " max", closed_rooms, [c, walls] { return with_roulette(walls, c.albedo, "max", c.spp); }});
            cases.push_back({what + " off", closed_rooms, [c, walls] { return without_roulette(walls, c.albedo); }});
        }
    for (const char* rule : {"luminance", "sqrt", "constant=0.995"})
        cases.push_back({fmt::format("closed sphere, rho 0.99, roulette {}", rule), closed_rooms,
                         [rule] { return with_roulette(sphere(true), 0.99f, rule, 32); }});
    for (const float albedo : {0.5f, 0.9f, 0.99f, 0.999f, 1 - 1e-4f, 1.f})
        cases.push_back(
            {fmt::format("white furnace, rho {:.4g}", albedo), closed_rooms, [albedo] { return white_furnace(lambert(albedo)); }});
    return cases;
}

} // namespace blush::stability
