// Stability cases of parallel emissive mirrors: after n reflections exactly n + 1 terms of a geometric series.
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"

#include <cmath>
#include <fmt/format.h>

namespace blush::stability {
namespace {

Findings corridor(float albedo, int bounces) {
    Scene scene;
    Material mirror = metal(0);
    mirror.base_color = {albedo, albedo, albedo};
    mirror.emissive = {1, 1, 1};
    place(scene, floor_quad(2, -1), mirror);
    place(scene, ceiling_quad(2, 1), mirror);
    scene.view = looking_down(1, 0);
    RenderSettings settings = settings_for(8, 8, 1);
    settings.max_bounces = bounces;
    settings.roulette.rule = Roulette::Rule::off;
    const double rho = double(albedo), expected = (1 - std::pow(rho, bounces + 1)) / (1 - rho);
    // Each term has one more factor.
    return every_pixel(render(scene, settings), expected, 4 * std::sqrt(double(bounces)) * 0x1p-24 * expected);
}

} // namespace

std::vector<StabilityCase> mirror_cases() {
    std::vector<StabilityCase> cases;
    for (const float albedo : {0.9f, 0.99f, 0.999f})
        for (const int bounces : {3, 300})
            cases.push_back({fmt::format("corridor of rho {}, {} bounces", albedo, bounces), closed_rooms,
                             [albedo, bounces] { return corridor(albedo, bounces); }});
    return cases;
}

} // namespace blush::stability
