// Stability cases of geometry: degenerate and coincident triangles; rotating, non-uniform and mirroring transforms.
#include "core/math.h"
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"
#include "scene/affine.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace blush::stability {
namespace {

constexpr float lux = 3, albedo = 0.8f;

GeometryPtr changed(const GeometryPtr& from, auto&& change) {
    Geometry g = *from;
    g.serial = next_payload_serial();
    change(g);
    return std::make_shared<const Geometry>(std::move(g));
}

void add_sun(Scene& scene, const Vec3& direction) {
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = lux;
    place_light(scene, sun, aimed({0, 0, 0}, direction));
}

// Pixel value of a floor under the sun.
constexpr double sunlit = double(albedo) * double(lux) / std::numbers::pi;

// ---- bad triangles

// A room of two cones with n sides each; all triangles are slivers of aspect n / 2 pi.
GeometryPtr needle_room(int sides) {
    Geometry g;
    g.positions = {{0, 1, 0}, {0, -1, 0}};
    for (int i = 0; i < sides; ++i) {
        const double phi = 2 * std::numbers::pi * i / sides;
        g.positions.push_back({float(std::cos(phi)), 0, float(std::sin(phi))});
    }
    for (int i = 0; i < sides; ++i) {
        const uint32_t a = 2 + uint32_t(i), b = 2 + uint32_t((i + 1) % sides);
        for (const uint32_t k : {0u, a, b, 1u, b, a}) g.indices.push_back(k);
    }
    return std::make_shared<const Geometry>(std::move(g));
}

Findings slivers(int sides) {
    Scene scene;
    place(scene, needle_room(sides), emitter(1, 0.5f));
    scene.view = looking({0.1f, 0.05f, 0.2f}, {1, 0.4f, -0.3f}, 1.2f);
    return whole(render(scene, settings_for(16, 16, 64)), 2);
}

// A closed room in bright sun and sky is black inside.
Findings dark_room(const GeometryPtr& walls, const Vec3& centre) {
    Scene scene;
    place(scene, walls, lambert(albedo), at(centre));
    add_sun(scene, {1, -1, 0.5f});
    constant_world(scene, 1);
    scene.view = looking({0, 0, 0}, {0.577f, -0.577f, 0.577f}, 1.6f);
    scene.view.position = centre;
    RenderSettings settings = settings_for(48, 48, 8);
    settings.max_bounces = 8;
    settings.roulette.rule = Roulette::Rule::off;
    return {count_of(render(scene, settings).whole().mean.x)};
}

// An emissive mesh with many degenerate triangles.
Findings degenerate_lamp() {
    Scene scene;
    const GeometryPtr lamp = changed(ceiling_quad(0.5f, 1), [](Geometry& g) {
        for (int i = 0; i < 100; ++i) {
            for (const uint32_t k : {0u, 0u, 1u, 2u, 2u, 2u}) g.indices.push_back(k);
            const uint32_t n = uint32_t(g.positions.size()); // three collinear corners
            for (const float x : {-0.5f, 0.f, 0.5f}) g.positions.push_back({x, 1, 0.1f});
            for (const uint32_t k : {n, n + 1, n + 2}) g.indices.push_back(k);
        }
        g.uv.clear();
    });
    place(scene, lamp, emitter(3));
    const Vec3d corners[] = {{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}};
    return quarters(scene, [&](const Vec3d& x) { return 3 * polygon_irradiance(x, up, corners); });
}

Findings sunlit_floor(Scene scene) {
    add_sun(scene, {0, -1, 0});
    scene.view = looking_down(0.9f, 3);
    return every_pixel(render(scene, settings_for(16, 16, 4)), sunlit);
}
Findings degenerate_floor() {
    Scene scene;
    const GeometryPtr floor = changed(floor_quad(1), [](Geometry& g) {
        for (const uint32_t k : {0u, 0u, 0u, 1u, 3u, 1u, 0u, 2u, 2u}) g.indices.push_back(k);
    });
    place(scene, floor, lambert(albedo));
    return sunlit_floor(scene);
}
Findings duplicates(int copies) {
    Scene scene;
    const GeometryPtr floor = changed(floor_quad(1), [copies](Geometry& g) {
        const GeometryArray<uint32_t> once = g.indices;
        for (int i = 1; i < copies; ++i) g.indices.insert(g.indices.end(), once.begin(), once.end());
    });
    place(scene, floor, lambert(albedo));
    return sunlit_floor(scene);
}
// Coplanar overlapping floors of both windings.
Findings coplanar() {
    Scene scene;
    place(scene, floor_quad(1), lambert(albedo));
    place(scene, floor_quad(0.5f), lambert(albedo), at({0.25f, 0, 0}));
    place(scene, quad({-0.5f, 0, -1}, {1, 0, -0.5f}, {0.5f, 0, 1}, {-1, 0, 0.5f}), lambert(albedo));
    return sunlit_floor(scene);
}
// Coincident sheets with 98 % transmittance each.
Findings coincident_sheets(int sheets) {
    Scene scene;
    Material sheet = lambert(0.f);
    sheet.alpha = Material::Alpha::blend;
    sheet.opacity = 0.02f;
    for (int i = 0; i < sheets; ++i) place(scene, floor_quad(100, 0.5f), sheet);
    add_sun(scene, {0, -1, 0});
    return quarters(scene, [sheets](const Vec3d&) { return double(lux) * std::pow(1 - double(0.02f), sheets); });
}

// ---- transforms

Findings squashed_ball(const Vec3& scale) {
    Scene scene;
    Transform t;
    t.scale = scale;
    t.rotation = {0.1f, 0.3f, 0.2f, 0.9f};
    place(scene, sphere(false), lambert(albedo), t);
    constant_world(scene, 1);
    // Seen along the ball's shortest axis, from its shadow side.
    const Vec3d axis = normalize(to_affine(t.rotation).y);
    const float away = 4 * std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)});
    scene.view = looking(to_float(axis * double(away)), {0, 0, 0}, 1);
    scene.view.lens.orthographic = true;
    scene.view.lens.ymag = 0.3f * std::min(std::abs(scale.x), std::abs(scale.z));
    return whole(render(scene, settings_for(16, 16, 64)), double(albedo));
}

Findings scaled_area_light(const Vec3& scale) {
    Scene scene;
    Light light;
    light.kind = Light::Kind::rectangle;
    light.intensity = 3;
    Transform pose = aimed({0.2f, 1, 0.1f}, {0.1f, -1, 0.2f});
    pose.scale = scale;
    place_light(scene, light, pose);
    const auto corners = rectangle_corners(light, pose);
    const bool shines_down = scale.z > 0;
    return quarters(scene, [&](const Vec3d& x) { return shines_down ? 3 * polygon_irradiance(x, up, corners) : 0; });
}

// A floor with tilted vertex normals under a shear: normals transform by the inverse transpose.
Findings sheared_normals(float shear) {
    const Vec3d n = normalize(Vec3d{0.3, 1, -0.2});
    const GeometryPtr floor = changed(floor_quad(1), [&](Geometry& g) { g.normals.assign(4, to_float(n)); });
    Transform t;
    t.matrix = Affine{{1, 0, 0}, {shear, 1, 0}, {0.5f, 0, 2}, {0, 0, 0}};
    const Vec3d normal = normalize(transform_vector(cofactor(to_double(*t.matrix)), n));
    Scene scene;
    place(scene, floor, lambert(albedo), t);
    const Vec3 direction{-0.2f, -1, 0.3f};
    add_sun(scene, direction);
    scene.view = looking_down(0.4f, 3);
    const double cos = -dot(normalize(to_double(direction)), normal);
    return every_pixel(render(scene, settings_for(8, 8, 4)), sunlit * std::max(0.0, cos), 0x1p-20);
}

} // namespace

std::vector<StabilityCase> geometry_cases() {
    std::vector<StabilityCase> cases;
    for (const int sides : {1000, 10000})
        cases.push_back({fmt::format("room of {} slivers", 2 * sides), leaving_surfaces, [sides] { return slivers(sides); }});
    cases.push_back({"dark room of 2000 slivers", leaving_surfaces, [] { return dark_room(needle_room(1000), {0, 0, 0}); }});
    cases.push_back({"dark cube", leaving_surfaces, [] { return dark_room(cube(true), {0, 0, 0}); }});
    cases.push_back({"dark ball", leaving_surfaces, [] { return dark_room(sphere(true), {0, 0, 0}); }});
    cases.push_back({"light with 300 triangles of no area", no_area, degenerate_lamp});
    cases.push_back({"floor with triangles of no area", no_area, degenerate_floor});
    for (const int copies : {2, 1000})
        cases.push_back({fmt::format("floor of {} coincident copies", copies), leaving_surfaces, [copies] { return duplicates(copies); }});
    cases.push_back({"floors that overlap in one plane", leaving_surfaces, coplanar});
    for (const int sheets : {2, 50})
        cases.push_back({fmt::format("{} coincident sheets of 2 %", sheets), transparency, [sheets] { return coincident_sheets(sheets); }});
    for (const Vec3& scale : {Vec3{1, 1e-3f, 1}, Vec3{1, 1e-3f, 1e3f}, Vec3{-1, 1, 1}, Vec3{-2, -0.5f, -1}})
        cases.push_back({fmt::format("ball scaled by ({:g}, {:g}, {:g})", scale.x, scale.y, scale.z), nested_solids,
                         [scale] { return squashed_ball(scale); }});
    for (const Vec3& scale : {Vec3{0.1f, 3, 1}, Vec3{-1, 1, 1}, Vec3{1, -2, 1}, Vec3{-1, -1, -1}})
        cases.push_back({fmt::format("area light scaled by ({:g}, {:g}, {:g})", scale.x, scale.y, scale.z), nested_solids,
                         [scale] { return scaled_area_light(scale); }});
    for (const float shear : {0.f, 1.f, -2.f})
        cases.push_back({fmt::format("vertex normals sheared by {}", shear), frames, [shear] { return sheared_normals(shear); }});
    return cases;
}

} // namespace blush::stability
