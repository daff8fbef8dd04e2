// Rays that leave a surface neither hit it again nor leak through it, at any scale and far from the origin. With a parallel sun
// there is no noise: every lit pixel must be exact.
#include "core/math.h"
#include "scene/affine.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

constexpr float lux = 3, albedo = 0.8f;

Scene sunlit(const GeometryPtr& geometry, const Transform& transform, const Vec3& sun_direction) {
    Scene scene;
    place(scene, geometry, lambert(albedo), transform);
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = lux;
    place_light(scene, sun, aimed({0, 0, 0}, sun_direction));
    return scene;
}

// A view with a distant camera that frames a body of the given size at `centre`.
View view_of(const Vec3& centre, float size, const Vec3& from) {
    const Vec3d eye = to_double(centre) + normalize(to_double(from)) * (3.0 * double(size));
    View view = looking({0, 0, 0}, to_float(normalize(to_double(from)) * -1.0), 1);
    view.position = to_float(eye);
    view.lens.orthographic = true;
    view.lens.ymag = 0.9f * size;
    return view;
}

// Every hit pixel shows albedo / pi times the sun's cosine with its own normal, and 0 where it faces away.
void expect_exactly_lit(const Scene& scene, const Vec3& sun_direction, const std::string& what) {
    const RenderedImage image = render(scene, settings_for(48, 48, 1), {.normal = true, .depth = true});
    const Vec3d to_sun = normalize(to_double(sun_direction)) * -1.0;
    int wrong = 0, lit = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        if (image.frame.depth[i] == 0) continue;
        const double cos = dot(to_double(image.frame.normal[i]), to_sun);
        if (std::abs(cos) < 1e-4) continue; // the side depends on rounding
        const double expected = cos > 0 ? double(albedo) / std::numbers::pi * double(lux) * cos : 0;
        wrong += std::abs(image.pixels[i].x - expected) > 1e-5;
        lit += cos > 0;
    }
    EXPECT_GT(lit, 200) << what;
    EXPECT_EQ(wrong, 0) << what << ", sun " << sun_direction.x << " " << sun_direction.y << " " << sun_direction.z;
}

const std::vector<Vec3> sun_directions = {{0, -1, 0}, {1, -1, 0.5f}, {-1, -0.05f, 0.2f}};

TEST(Offsets, PlanesAtAllScales) {
    for (const float scale : {1e-3f, 0.1f, 1.f, 100.f, 1e3f})
        for (const Vec3& sun : sun_directions)
            for (const float tilt : {0.f, 0.03f, -0.3f}) {
                Transform t = at({0, 0, 0}, scale);
                t.rotation = {std::sin(tilt / 2), 0, 0, std::cos(tilt / 2)};
                Scene scene = sunlit(floor_quad(1), t, sun);
                scene.view = view_of({0, 0, 0}, scale, {0.3f, 1, 0.2f});
                expect_exactly_lit(scene, sun, "scale " + std::to_string(scale) + ", tilt " + std::to_string(tilt));
            }
}

TEST(Offsets, PlanesFarFromTheOrigin) {
    for (const Vec3& centre : {Vec3{1000, 0, 0}, Vec3{0, 1000, 0}, Vec3{-1000, 1000, 500}, Vec3{1e5f, -2e4f, 3e5f}})
        for (const Vec3& sun : sun_directions) {
            Scene scene = sunlit(floor_quad(1), at(centre), sun);
            scene.view = view_of(centre, 1, {0.3f, 1, 0.2f});
            expect_exactly_lit(scene, sun, "at " + std::to_string(centre.x));
        }
}

// A quad in each of the three coordinate planes, where coordinates are exactly 0.
TEST(Offsets, AxisAlignedPlanesThroughTheOrigin) {
    const GeometryPtr quads[] = {quad({0, -1, 1}, {0, -1, -1}, {0, 1, -1}, {0, 1, 1}), floor_quad(1),
                                 quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0})};
    const Vec3 sun{-1, -0.8f, -0.6f};
    for (const GeometryPtr& geometry : quads) {
        Scene scene = sunlit(geometry, {}, sun);
        scene.view = view_of({0, 0, 0}, 1, {0.5f, 0.6f, 0.7f});
        expect_exactly_lit(scene, sun, "through the origin");
    }
}

TEST(Offsets, SpheresAtAllScalesAndPlaces) {
    for (const Vec3& sun : sun_directions) {
        for (const float scale : {1e-3f, 0.1f, 1.f, 100.f, 1e3f}) {
            Scene scene = sunlit(sphere(false), at({0, 0, 0}, scale), sun);
            scene.view = view_of({0, 0, 0}, scale, {0.3f, 1, 0.2f});
            expect_exactly_lit(scene, sun, "scale " + std::to_string(scale));
        }
        for (const Vec3& centre : {Vec3{1000, 0, 0}, Vec3{-300, 1000, 700}}) {
            Scene scene = sunlit(sphere(false), at(centre), sun);
            scene.view = view_of(centre, 1, {0.3f, 1, 0.2f});
            expect_exactly_lit(scene, sun, "at " + std::to_string(centre.x));
        }
    }
}

TEST(Offsets, InstancesToo) {
    for (const Vec3& sun : sun_directions)
        for (const float scale : {1e-3f, 1.f, 1e3f}) {
            Scene scene;
            const Id<Mesh> mesh = scene.meshes.add({"", {{sphere(false), scene.materials.add(lambert(albedo))}}});
            for (const float x : {0.f, 2000 * scale}) {
                Node node;
                node.mesh = mesh;
                node.local = at({x, 0, x}, scale);
                node.local.rotation = {0.1f, 0.3f, 0.2f, 0.9f};
                scene.nodes.add(node);
            }
            Light light;
            light.kind = Light::Kind::sun;
            light.intensity = lux;
            place_light(scene, light, aimed({0, 0, 0}, sun));
            for (const float x : {0.f, 2000 * scale}) {
                scene.view = view_of({x, 0, x}, scale, {0.3f, 1, 0.2f});
                expect_exactly_lit(scene, sun, "instance of scale " + std::to_string(scale) + " at " + std::to_string(x));
            }
        }
}

// Mean radiance that leaks into a closed room under the sun and a sky of radiance 1.
double leak(const GeometryPtr& walls, const Vec3& centre, float scale, int bounces) {
    Scene scene = sunlit(walls, at(centre, scale), {1, -1, 0.5f});
    constant_world(scene, 1);
    scene.view = looking({0, 0, 0}, {0.577f, -0.577f, 0.577f}, 1.6f); // into a corner
    scene.view.position = centre;
    RenderSettings settings = settings_for(48, 48, 8);
    settings.max_bounces = bounces;
    settings.roulette.rule = Roulette::Rule::off;
    return render(scene, settings).whole().mean.x;
}

TEST(Offsets, ClosedRoomsAreDarkEverywhere) {
    for (const GeometryPtr& walls : {cube(true), sphere(true)})
        for (const float scale : {1e-3f, 1.f, 1e3f})
            for (const Vec3& centre : {Vec3{0, 0, 0}, Vec3{3, -1, 2}, Vec3{1000, -300, 700}, Vec3{1e7f, 2e6f, -1e7f}})
                EXPECT_EQ(leak(walls, centre * scale, scale, 8), 0) << "scale " << scale << ", at " << centre.x << " of its size";
}

} // namespace
} // namespace blush::test::TEST_FILE
