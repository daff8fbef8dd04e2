// Stability cases of scale and position: the image of a scene must not depend on its scale or its distance from the origin.
#include "core/math.h"
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"
#include "scene/affine.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace blush::stability {
namespace {

// All objects are children of one node, so that fractions of a metre are kept far from the origin: only the root and the camera
// have positions there, which are exact in single precision.
Scene still_life(float scale, const Vec3& away) {
    Scene scene;
    Node root;
    root.local = at(away, scale);
    const Id<Node> parent = scene.nodes.add(root);
    const auto hang = [&](Id<Node> id) {
        Node node = *scene.nodes.find(id);
        node.parent = parent;
        scene.nodes.set(id, node);
    };
    hang(place(scene, floor_quad(2), lambert({0.7f, 0.7f, 0.7f})));
    hang(place(scene, sphere(false), metal(0.4f), at({-0.55f, 0.5f, 0.1f}, 0.5f)));
    hang(place(scene, cube(false), lambert(0.5f), at({0.7f, 0.3f, 0.4f}, 0.3f)));
    hang(place(scene, sphere(false), plastic(0.2f), at({0.3f, 0.2f, -0.6f}, 0.2f)));
    Light lamp;
    lamp.kind = Light::Kind::rectangle;
    lamp.intensity = 4;
    hang(place_light(scene, lamp, aimed({0.4f, 2.2f, 0.3f}, {-0.2f, -1, 0})));
    constant_world(scene, 0.2f);
    scene.view = looking({0, 2, 4}, {0, 0.25f, 0}, 0.6f);
    scene.view.position = scene.view.position * scale + away;
    return scene;
}

constexpr int side = 48, block = 12;

RenderedImage still_life_image(float scale, const Vec3& away, uint32_t seed) {
    RenderSettings settings = settings_for(side, side, 64);
    settings.seed = seed;
    return render(still_life(scale, away), settings);
}
const RenderedImage& original() {
    static const RenderedImage image = still_life_image(1, {0, 0, 0}, 0);
    return image;
}

// If all numbers round identically, images must be bit-identical.
Findings same_bits(float scale, const Vec3& away) {
    const RenderedImage other = still_life_image(scale, away, 0);
    int differ = 0;
    for (size_t i = 0; i < other.pixels.size(); ++i) differ += other.pixels[i] != original().pixels[i];
    return {count_of(differ, "pixels that differ")};
}
Findings same_render(float scale, const Vec3& away) { return same_blocks(original(), still_life_image(scale, away, 1), block); }

// A ball under a parallel sun: each pixel has exactly the cosine term or is in shadow.
Findings sunlit_ball(float scale, const Vec3& centre) {
    constexpr float albedo = 0.8f, lux = 3;
    Scene scene;
    place(scene, sphere(false), lambert(albedo), at(centre, scale));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = lux;
    const Vec3 direction{1, -1, 0.5f};
    place_light(scene, sun, aimed({0, 0, 0}, direction));
    scene.view = looking({0, 0, 0}, {0, 0, -1}, 1);
    scene.view.position = centre + Vec3{0, 0, 4 * scale};
    scene.view.lens.orthographic = true;
    scene.view.lens.ymag = scale;
    const RenderedImage image = render(scene, settings_for(48, 48, 1), {.normal = true, .depth = true});
    const Vec3d to_sun = normalize(to_double(direction)) * -1.0;
    int wrong = 0, lit = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        if (image.frame.depth[i] == 0) continue;
        const double cos = dot(to_double(image.frame.normal[i]), to_sun);
        if (std::abs(cos) < 1e-4) continue; // the side depends on rounding
        const double expected = cos > 0 ? double(albedo) / std::numbers::pi * double(lux) * cos : 0;
        wrong += !(std::abs(image.pixels[i].x - expected) <= 1e-5);
        lit += cos > 0;
    }
    return {count_of(wrong, "pixels that are lit wrongly"), count_of(lit < 200, "too few pixels are lit")};
}

// Two balls with a shared mesh are traced as instances.
Findings instanced_balls(float scale) {
    Scene scene;
    const Id<Mesh> mesh = scene.meshes.add({"", {{sphere(true), scene.materials.add(emitter(1, 0.5f))}}});
    for (const float x : {0.f, 1e4f}) {
        Node node;
        node.mesh = mesh;
        node.local = at({x * scale, 0, 0}, scale);
        scene.nodes.add(node);
    }
    scene.view = looking({0, 0, 0}, {0.9f, 0.35f, -0.8f}, 1.2f);
    return whole(render(scene, settings_for(16, 16, 64)), 2);
}

} // namespace

std::vector<StabilityCase> scale_cases() {
    std::vector<StabilityCase> cases;
    for (const int exponent : {20, -20})
        cases.push_back({fmt::format("still life scaled by 2^{}, bit for bit", exponent), scales, [exponent] {
                             return same_bits(std::ldexp(1.f, exponent), {0, 0, 0});
                         }});
    for (const float scale : {1e-6f, 1e-3f, 1e3f, 1e6f})
        cases.push_back({fmt::format("still life scaled by {:g}", scale), scales, [scale] { return same_render(scale, {0, 0, 0}); }});
    for (const Vec3& away : {Vec3{1e7f, 0, 0}, Vec3{0, -1e7f, 0}, Vec3{-1e7f, 1e7f, 1e7f}})
        cases.push_back({fmt::format("still life at ({:g}, {:g}, {:g}), bit for bit", away.x, away.y, away.z), far_away,
                         [away] { return same_bits(1, away); }});
    for (const Vec3& away : {Vec3{1234567, -7654321, 9999991}, Vec3{100, 20, -30}})
        cases.push_back({fmt::format("still life at ({:.7g}, {:.7g}, {:.7g})", away.x, away.y, away.z), far_away,
                         [away] { return same_render(1, away); }});
    cases.push_back({"still life scaled by 1024, at 2^33 m, bit for bit", far_away, [] {
                         return same_bits(1024, {0x1p33f, 0, -0x1p33f});
                     }});
    for (const float scale : {1e-6f, 1.f, 1e6f})
        cases.push_back({fmt::format("sunlit ball of radius {:g} m", scale), leaving_surfaces, [scale] {
                             return sunlit_ball(scale, {0, 0, 0});
                         }});
    cases.push_back({"sunlit ball at 1e7 m", far_away, [] { return sunlit_ball(1, {1e7f, -2e6f, 1e7f}); }});
    for (const float scale : {1e-6f, 1e6f})
        cases.push_back(
            {fmt::format("instanced closed balls of radius {:g} m", scale), scales, [scale] { return instanced_balls(scale); }});
    return cases;
}

} // namespace blush::stability
