// Stability cases of non-finite input: the affected element is skipped without an effect on others.
#include "core/math.h"
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"

#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace blush::stability {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

// For a floor it covers: the right half of an image from above shows texels of 1.
ImagePtr one_bad(float bad) { return float_image(2, 2, std::vector<Vec3>{{bad, bad, bad}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}); }

Findings sound(const Scene& scene, double expected) {
    const RenderedImage image = render(scene, settings_for(16, 16, 16));
    Findings all{compare(image.region(8, 8, 8, 8), expected)};
    int broken = 0;
    for (const Vec3d& p : image.pixels) broken += !(p.x >= 0 && p.x < 1e30);
    all.push_back(count_of(broken, "pixels that are no radiance"));
    return all;
}

Findings bad_color(float bad) {
    Scene scene;
    Material material = lambert(0.5f);
    material.base_color_texture.texture = add_texture(scene, one_bad(bad));
    place(scene, floor_quad(1), material);
    constant_world(scene, 1);
    scene.view = looking_down(1, 1);
    return sound(scene, 0.5);
}
Findings bad_emission(float bad) {
    Scene scene;
    Material material = emitter(3);
    material.emissive_texture.texture = add_texture(scene, one_bad(bad));
    place(scene, floor_quad(1), material);
    scene.view = looking_down(1, 1);
    return sound(scene, 3);
}
// Below the horizon, invisible to the floor.
Findings bad_world(float bad) {
    Scene scene;
    place(scene, floor_quad(1), lambert(0.5f));
    std::vector<Vec3> texels(64 * 32, Vec3{1, 1, 1});
    texels[64 * 31 + 7] = {bad, bad, bad};
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = float_image(64, 32, texels);
    scene.view = looking_down(1, 1);
    return sound(scene, 0.5);
}

// A floor under the sun, with a broken object beside it.
Findings beside(auto&& add_broken) {
    Scene scene;
    place(scene, floor_quad(1), lambert(0.5f));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = 2;
    place_light(scene, sun, aimed({0, 0, 0}, {0, -1, 0}));
    add_broken(scene);
    scene.view = looking_down(1, 1);
    return sound(scene, 0.5 * 2 / std::numbers::pi);
}
void add_bad_vertex(Scene& scene, float bad) {
    Geometry g = *floor_quad(0.2f, 0.2f);
    g.serial = next_payload_serial();
    for (Vec3& p : g.positions) p = p + Vec3{-0.7f, 0, -0.7f};
    g.positions[0].y = bad;
    place(scene, std::make_shared<const Geometry>(std::move(g)), lambert(0.5f));
}
void add_bad_normals(Scene& scene) {
    Geometry g = *floor_quad(0.2f, 0.2f);
    g.serial = next_payload_serial();
    for (Vec3& p : g.positions) p = p + Vec3{-0.7f, 0, -0.7f};
    g.normals.assign(4, {nan, nan, nan});
    place(scene, std::make_shared<const Geometry>(std::move(g)), lambert(0.5f));
}
void add_bad_transform(Scene& scene) {
    Transform nowhere;
    nowhere.translation = {nan, 0, 0};
    place(scene, floor_quad(1), lambert(0.5f), nowhere);
}
void add_bad_material(Scene& scene) {
    Material m = plastic(nan);
    m.base_color = {nan, inf, -1};
    m.ior = -inf;
    m.emissive = {nan, -1, 1};
    place(scene, floor_quad(0.2f, 0.2f), m, at({-0.7f, 0, -0.7f}));
}
void add_bad_light(Scene& scene) {
    Light bulb;
    bulb.intensity = nan;
    place_light(scene, bulb, at({0, 1, 0}));
}

} // namespace

std::vector<StabilityCase> health_cases() {
    std::vector<StabilityCase> cases;
    for (const float bad : {nan, inf, -1.f}) {
        cases.push_back({fmt::format("texel of {} in a colour", bad), not_numbers, [bad] { return bad_color(bad); }});
        cases.push_back({fmt::format("texel of {} in a light", bad), not_numbers, [bad] { return bad_emission(bad); }});
        cases.push_back({fmt::format("texel of {} in the world", bad), not_numbers, [bad] { return bad_world(bad); }});
    }
    for (const float bad : {nan, inf, 1e38f})
        cases.push_back(
            {fmt::format("vertex at {:g}", bad), not_numbers, [bad] { return beside([bad](Scene& s) { add_bad_vertex(s, bad); }); }});
    cases.push_back({"normals of nan", not_numbers, [] { return beside(add_bad_normals); }});
    cases.push_back({"transform of nan", not_numbers, [] { return beside(add_bad_transform); }});
    cases.push_back({"material of nan and inf", not_numbers, [] { return beside(add_bad_material); }});
    cases.push_back({"light of nan", not_numbers, [] { return beside(add_bad_light); }});
    return cases;
}

} // namespace blush::stability
