// Known limits of the renderer, with reason and size. A limit that starts to pass fails the tests: it must then be moved to its
// group.
#include "core/math.h"
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"
#include "scene/affine.h"

#include <cmath>
#include <numbers>

namespace blush::stability {
namespace {

// The sum of all bounces, not only of the first 100000.
Findings max_path_length() {
    constexpr float albedo = 1 - 1e-4f;
    Scene scene;
    place(scene, sphere(true), emitter(2, albedo));
    scene.view = looking({0.1f, -0.2f, 0.3f}, {0.9f, 0.35f, -0.8f}, 1.2f);
    RenderSettings settings = settings_for(2, 2, 1);
    settings.roulette.rule = Roulette::Rule::off;
    settings.strategy = Strategy::bsdf;
    return whole(render_anything(scene, settings), 2 / (1 - double(albedo)));
}

// A rough ball should become invisible as its index approaches 1.
Findings rough_glass_towards_vacuum() {
    Scene scene;
    place(scene, sphere(false), glass(0.5f, 1.001f));
    constant_world(scene, 1);
    scene.view = looking({0.4f, 1.1f, 3}, {0, 0, 0}, 0.4f);
    return whole(render(scene, settings_for(16, 16, 64)), 1);
}

// A ball of glass within a block of the same glass should be invisible: compares with the block alone.
Findings glass_within_glass() {
    const auto block = [](bool with_ball) {
        Scene scene;
        place(scene, cube(false), glass(0, 1.5f));
        if (with_ball) place(scene, sphere(false), glass(0, 1.5f), at({0, 0, 0}, 0.9f));
        place(scene, floor_quad(0.5f, -2), emitter(1));
        scene.view = looking_down(0.5f, 3);
        return render(scene, settings_for(16, 16, 64)).whole();
    };
    const Measured without = block(false);
    Finding f = compare(block(true), without.mean.x);
    f.sigma = std::hypot(f.sigma, without.error.x);
    return {f};
}

// A sheet 1e-7 as thick as wide: the offset of a ray that enters it moves the origin past its other face.
Findings wafer() {
    Scene scene;
    Material solid = glass(0, 1);
    solid.attenuation_color = {0.5f, 0.5f, 0.5f};
    solid.attenuation_distance = 1e-7f;
    Transform shape;
    shape.scale = {1, 0.5e-7f, 1};
    place(scene, cube(false), solid, shape);
    constant_world(scene, 1);
    scene.view = looking_down(0.9f, 1);
    return whole(render(scene, settings_for(16, 16, 4)), 0.5);
}

// Shading terminator: parts of a ball whose shading normals face the sun but whose facets do not are black.
Findings terminator() {
    Geometry g = *sphere(false);
    g.serial = next_payload_serial();
    g.normals = g.positions;
    Scene scene;
    place(scene, std::make_shared<const Geometry>(std::move(g)), lambert(1.f));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = float(std::numbers::pi);
    const Vec3 direction{1, -0.3f, 0.2f};
    place_light(scene, sun, aimed({0, 0, 0}, direction));
    scene.view = looking({0, 0, 4}, {0, 0, 0}, 1);
    scene.view.lens.orthographic = true;
    scene.view.lens.ymag = 0.7f;
    const RenderedImage image = render(scene, settings_for(64, 64, 4), {.normal = true});
    const Vec3d to_sun = normalize(to_double(direction)) * -1.0;
    double expected = 0;
    for (const Vec3& n : image.frame.normal) expected += std::max(0.0, dot(to_double(n), to_sun));
    return whole(image, expected / double(image.frame.normal.size()));
}

// Two coincident lights: NEE sees both, a ray hits only one. The correct result is undefined.
Findings coincident_lights() {
    Scene scene;
    for (int i = 0; i < 2; ++i) place(scene, ceiling_quad(0.5f, 1), emitter(3));
    const Vec3d corners[] = {{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}};
    return quarters(scene, [&](const Vec3d& x) { return 3 * polygon_irradiance(x, Vec3d{0, 1, 0}, corners); });
}

// A room of one metre in a scene of 1000 km: the scene has a single origin, and single precision has steps of 0.06 m there.
Findings room_in_a_wide_world() {
    Scene scene;
    place(scene, cube(true), lambert(0.8f), at({1e6f, 0, 0}));
    place(scene, floor_quad(1), lambert(0.8f), at({-1e6f, 0, 0}));
    constant_world(scene, 1);
    scene.view = looking({0, 0, 0}, {0.577f, -0.577f, 0.577f}, 1.6f);
    scene.view.position = {1e6f, 0, 0};
    RenderSettings settings = settings_for(48, 48, 64);
    settings.max_bounces = 8;
    settings.roulette.rule = Roulette::Rule::off;
    return {count_of(render(scene, settings).whole().mean.x)};
}

// Triangles whose squared area exceeds the range of single precision have no normal.
Findings closed_ball(float scale) {
    Scene scene;
    place(scene, sphere(true), emitter(1, 0.5f), at({0, 0, 0}, scale));
    scene.view = looking({0, 0, 0}, {0.9f, 0.35f, -0.8f}, 1.2f);
    const RenderedImage image = render_anything(scene, settings_for(16, 16, 4));
    return {compare(image.whole(), 2), count_of(double(image.frame.health.dropped()), "samples dropped")};
}

// A camera 0.3 m from the nearest single precision position.
Findings camera_between_floats() {
    const Vec3 away{1e7f, 0, 0};
    Scene scene;
    Node root;
    root.local = at(away);
    const Id<Node> parent = scene.nodes.add(root);
    const Id<Node> half = place(scene, floor_quad(1), emitter(1), at({-1 + 0.3f, 0, 0}));
    Node node = *scene.nodes.find(half);
    node.parent = parent;
    scene.nodes.set(half, node);
    scene.view = looking_down(1, 1);
    scene.view.position = Vec3{0.3f, 1, 0} + away;
    // The floor's edge is below the camera.
    return whole(render(scene, settings_for(16, 16, 16)), 0.5);
}

// glTF culls back faces of single-sided materials.
Findings back_of_a_surface() {
    Scene scene;
    place(scene, ceiling_quad(10, 0), lambert(0.5f));
    place(scene, floor_quad(10, -1), emitter(1));
    scene.view = looking_down(1, 1);
    return whole(render(scene, settings_for(8, 8, 16)), 1);
}

// glTF's specular layer over a diffuse base, viewed at that angle in a white furnace: it gains energy.
Findings white_dielectric(double degrees) {
    Scene scene;
    place(scene, floor_quad(1000), plastic(0));
    constant_world(scene, 1);
    const double angle = degrees * std::numbers::pi / 180;
    scene.view = looking({float(10 * std::sin(angle)), float(10 * std::cos(angle)), 0}, {0, 0, 0}, 1);
    scene.view.lens.orthographic = true;
    scene.view.lens.ymag = 0.1f;
    return whole(render(scene, settings_for(16, 16, 64)), 1);
}

// The floor beside a plate of glass that reflects the sun onto it: once with its face, which is found, and once from within, which is not.
// Paths end before the light is reflected more often.
Findings sun_reflected_within_a_plate() {
    constexpr double ior = 2.4, cosine = std::numbers::sqrt2 / 2;
    Scene scene = sunlit_floor_in_a_mirror();
    Transform plate = at({0.05f, 1.1f, 0});
    plate.scale = {0.05f, 0.6f, 5};
    place(scene, cube(false), glass(0, float(ior)), plate);
    RenderSettings settings = settings_for(16, 16, 64);
    settings.max_bounces = 5;
    const double c = std::sqrt(1 - 0.5 / (ior * ior)), s = (cosine - ior * c) / (cosine + ior * c),
                 p = (ior * cosine - c) / (ior * cosine + c), reflectance = (s * s + p * p) / 2;
    return whole(render_anything(scene, settings), 0.01 * (1 + reflectance + (1 - reflectance) * (1 - reflectance) * reflectance));
}

} // namespace

std::vector<StabilityCase> limit_cases() {
    return {
        {std::string(grazing_gain_case), 5, [] { return white_dielectric(75); },
         "appendix B of the glTF specification weights the diffuse base by 1 - F at the half vector, which is nearer to the viewer than "
         "the normal: at grazing angles base and reflection together exceed 1"},
        {"closed room of rho 0.9999 without roulette: all bounces", 15, max_path_length,
         "paths end after 100000 scattering events, which is counted and reported; with Russian roulette the sum is complete"},
        {"rough glass of ior 1.001 in a furnace", 7, rough_glass_towards_vacuum,
         "the microfacet model applies masking however small the refraction is; below an index of 1 + 1e-5 / alpha light "
         "passes straight"},
        {"ball of glass within a block of the same glass", 20, glass_within_glass,
         "every interface is treated as one with vacuum: there is no stack of nested media"},
        {"absorbing sheet 1e-7 as thick as wide", 20, wafer,
         "ray origins are offset by a bound on the rounding error, which scales with the largest coordinate: keep solids thicker than "
         "1e-6 of their extent"},
        {"coarse ball with shading normals, half lit", 5, terminator,
         "the shading terminator is not softened: facets that face away from a light are black, whatever their normals"},
        {"two coincident lights", 4, coincident_lights,
         "NEE adds both, a ray hits one: scenes with coincident emitters have no unique result"},
        {"dark room at the edge of a wide world", 2, room_in_a_wide_world,
         "one origin serves the whole scene: parts far smaller than their distance from its middle, in units of 1e-6, leak at their "
         "corners"},
        {"closed ball of radius 1e-10 m", 3, [] { return closed_ball(1e-10f); },
         "normals are normalised cross products in single precision: keep triangles between 1e-9 and 1e9 m across"},
        {"closed ball of radius 1e12 m", 3, [] { return closed_ball(1e12f); }, "as for the ball of 1e-10 m"},
        {"camera 0.3 m beside the metres at 1e7 m", 2, camera_between_floats,
         "node and camera positions are in single precision; make them children of a distant node"},
        {"parallel sun reflected within a plate onto a floor that a mirror shows", densities, sun_reflected_within_a_plate,
         "light paths cannot be connected to the camera by way of a mirror, and manifold sampling follows no partial reflections within "
         "glass; rays can hit a sun with an angle"},
        {"back of a surface that is not double-sided", 20, back_of_a_surface,
         "both sides of a surface reflect, as light transport requires; back-face culling of glTF is for rasterizers"},
    };
}

} // namespace blush::stability
