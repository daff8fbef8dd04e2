// What is known not to hold, with its reason and by how much. A limit that holds one day fails the tests: it belongs to its group then.
#include "core/math.h"
#include "measure/stability/findings.h"
#include "measure/stability/groups.h"
#include "scene/affine.h"

#include <cmath>
#include <numbers>

namespace blush::stability {
namespace {

constexpr double pi_d = std::numbers::pi;

// The sum of all bounces, not of the first hundred thousand.
Findings longest_path() {
    constexpr float albedo = 1 - 1e-4f;
    Scene scene;
    place(scene, sphere(true), emitter(2, albedo));
    scene.view = looking({0.1f, -0.2f, 0.3f}, {0.9f, 0.35f, -0.8f}, 1.2f);
    RenderSettings settings = settings_for(2, 2, 1);
    settings.roulette.rule = Roulette::Rule::off;
    settings.strategy = Strategy::bsdf;
    return whole(render_anything(scene, settings), 2 / (1 - double(albedo)));
}

// As the index goes to 1 a rough ball should vanish, as it does at 1.
Findings rough_glass_towards_vacuum() {
    Scene scene;
    place(scene, sphere(false), glass(0.5f, 1.001f));
    constant_world(scene, 1);
    scene.view = looking({0.4f, 1.1f, 3}, {0, 0, 0}, 0.4f);
    return whole(render(scene, settings_for(16, 16, 64)), 1);
}

// A ball of glass within a block of the same glass should be invisible: the block alone shows as much of the lamp.
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

// A sheet a ten-millionth as thick as it is wide: a ray that enters it is moved past its other face.
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

// Of a ball with shading normals, what those see of the sun but its facets do not is dark.
Findings terminator() {
    Geometry g = *sphere(false);
    g.serial = next_payload_serial();
    g.normals = g.positions;
    Scene scene;
    place(scene, std::make_shared<const Geometry>(std::move(g)), lambert(1.f));
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = float(pi_d);
    const Vec3 direction{1, -0.3f, 0.2f};
    shine(scene, sun, aimed({0, 0, 0}, direction));
    scene.view = looking({0, 0, 4}, {0, 0, 0}, 1);
    scene.view.lens.orthographic = true;
    scene.view.lens.ymag = 0.7f;
    const Picture picture = render(scene, settings_for(64, 64, 4), {.normal = true});
    const Vec3d to_sun = normalize(to_double(direction)) * -1.0;
    double expected = 0;
    for (const Vec3& n : picture.frame.normal) expected += std::max(0.0, dot(to_double(n), to_sun));
    return whole(picture, expected / double(picture.frame.normal.size()));
}

// Two lamps in the same place: light sampling sees both, a ray that meets them only one. Which is right nobody can say.
Findings coincident_lamps() {
    Scene scene;
    for (int i = 0; i < 2; ++i) place(scene, ceiling_quad(0.5f, 1), emitter(3));
    const Vec3d corners[] = {{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}};
    return quarters(scene, [&](const Vec3d& x) { return 3 * polygon_irradiance(x, Vec3d{0, 1, 0}, corners); });
}

// A room of one metre in a world that reaches a thousand kilometres: there is one origin for all, and single precision steps by 0.06 m
// there.
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

// Triangles whose area squared single precision cannot hold have no normal.
Findings closed_ball(float scale) {
    Scene scene;
    place(scene, sphere(true), emitter(1, 0.5f), at({0, 0, 0}, scale));
    scene.view = looking({0, 0, 0}, {0.9f, 0.35f, -0.8f}, 1.2f);
    const Picture picture = render_anything(scene, settings_for(16, 16, 4));
    return {compare(picture.whole(), 2), count_of(double(picture.frame.health.dropped()), "samples dropped")};
}

// A camera 0.3 m from where single precision can put it.
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
    // The floor's edge lies below the eye.
    return whole(render(scene, settings_for(16, 16, 16)), 0.5);
}

// glTF hides the back of a surface that is not double-sided.
Findings back_of_a_surface() {
    Scene scene;
    place(scene, ceiling_quad(10, 0), lambert(0.5f));
    place(scene, floor_quad(10, -1), emitter(1));
    scene.view = looking_down(1, 1);
    return whole(render(scene, settings_for(8, 8, 16)), 1);
}

// glTF's layering of a reflection over a matte base, seen at that angle in a white furnace: it gives back more than it gets.
Findings white_dielectric(double degrees) {
    Scene scene;
    place(scene, floor_quad(1000), plastic(0));
    constant_world(scene, 1);
    const double angle = degrees * pi_d / 180;
    scene.view = looking({float(10 * std::sin(angle)), float(10 * std::cos(angle)), 0}, {0, 0, 0}, 1);
    scene.view.lens.orthographic = true;
    scene.view.lens.ymag = 0.1f;
    return whole(render(scene, settings_for(16, 16, 64)), 1);
}

// A floor under a plate of solid glass and a parallel sun: what the sun sends through both faces, reflections between them included, is
// (1 - F) / (1 + F) with F = 0.04. No strategy finds it.
Findings sun_through_solid_glass() {
    constexpr double reflectance = 0.04, passes = (1 - reflectance) / (1 + reflectance);
    Scene scene;
    place(scene, floor_quad(50), lambert(0.5f));
    Transform plate = at({0, 1.1f, 0});
    plate.scale = {50, 0.1f, 50};
    place(scene, cube(false), glass(0, 1.5f), plate);
    Light sun;
    sun.kind = Light::Kind::sun;
    sun.intensity = float(pi_d);
    shine(scene, sun, aimed({0, 5, 0}, {0, -1, 0}));
    scene.view = looking_down(0.5f, 0.5f);
    RenderSettings settings = settings_for(16, 16, 4);
    settings.max_bounces = 3; // direct light through the plate
    return whole(render_anything(scene, settings), 0.5 * passes);
}

} // namespace

std::vector<StabilityCase> limit_cases() {
    return {
        {std::string(grazing_gain_case), 5, [] { return white_dielectric(75); },
         "appendix B of the glTF specification weighs the matte base by 1 - F at the half vector, which lies nearer to the viewer than the "
         "normal: at grazing angles base and reflection together exceed 1"},
        {"closed room of rho 0.9999 without roulette: all bounces", 15, longest_path,
         "paths end after 100000 scattering events, which is counted and reported; with roulette the sum is complete"},
        {"rough glass of ior 1.001 in a furnace", 7, rough_glass_towards_vacuum,
         "facets shadow each other in the microfacet model however little they refract; from an index of 1 + 1e-5 / alpha down light "
         "passes straight"},
        {"ball of glass within a block of the same glass", 20, glass_within_glass,
         "every interface is one with vacuum: no list of the media around a point is kept"},
        {"absorbing sheet 1e-7 as thick as wide", 20, wafer,
         "rays start off a surface by a bound on its rounding error, which follows its largest coordinate: keep solids thicker than 1e-6 "
         "of their extent"},
        {"coarse ball with shading normals, half lit", 5, terminator,
         "the shading terminator is not softened: where facets face away from a light it does not reach, whatever their normals say"},
        {"two lamps in one place", 4, coincident_lamps,
         "light sampling adds both, a ray finds one: scenes with coincident emitters have no single answer"},
        {"dark room at the edge of a wide world", 2, room_in_a_wide_world,
         "one origin serves the whole scene: parts far smaller than their distance from its middle, in units of 1e-6, leak at their "
         "corners"},
        {"closed ball of radius 1e-10 m", 3, [] { return closed_ball(1e-10f); },
         "normals are normalised cross products in single precision: keep triangles between 1e-9 and 1e9 m across"},
        {"closed ball of radius 1e12 m", 3, [] { return closed_ball(1e12f); }, "as for the ball of 1e-10 m"},
        {"camera 0.3 m beside the metres at 1e7 m", 2, camera_between_floats,
         "nodes and the camera are placed in single precision; hang them from a node that is far away"},
        {"floor under solid glass and a parallel sun", 4, sun_through_solid_glass,
         "a unidirectional path tracer finds lights without size neither by sampling nor by rays through delta lobes; thin panes pass them, and "
         "an angle of the sun lets rays find it"},
        {"back of a surface that is not double-sided", 20, back_of_a_surface,
         "both sides of a surface reflect, as light on its way through a room needs it; glTF's culling of backs is for rasterisers"},
    };
}

} // namespace blush::stability
