// Light units, conversion between types (equal illuminance), new lights, and angles.
#include "scene/lights/light_units.h"
#include "ui/lights/light_tools.h"
#include "ui/lights/new_light.h"
#include "ui/transform/rotation.h"
#include "ui/viewport/orbit_camera.h"

#include <gtest/gtest.h>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

constexpr Light::Kind kinds[] = {Light::Kind::point,     Light::Kind::spot, Light::Kind::sun,
                                 Light::Kind::rectangle, Light::Kind::disk, Light::Kind::sphere};

// Illuminance in lux on a surface facing the light, far enough away to treat the light as a point.
double illuminance(const Light& light, double distance) {
    switch (light.kind) {
    case Light::Kind::sun: return light.intensity;
    case Light::Kind::rectangle: return light.intensity * light.width * light.height / (distance * distance);
    case Light::Kind::disk:
    case Light::Kind::sphere: return light.intensity * std::numbers::pi * light.radius * light.radius / (distance * distance);
    default: return light.intensity / (distance * distance);
    }
}

TEST(LightKind, ConversionKeepsTheIlluminance) {
    for (const Light::Kind from : kinds) {
        for (const Light::Kind to : kinds) {
            Light light;
            light.kind = from;
            light.intensity = 7;
            light.width = 0.2f;
            light.height = 0.5f;
            if (is_per_area(from)) light.radius = 0.3f;
            const Light next = converted(light, to, 3);
            EXPECT_EQ(next.kind, to);
            EXPECT_NEAR(illuminance(next, 3) / illuminance(light, 3), 1, 1e-5) << int(from) << " to " << int(to);
        }
    }
}

TEST(LuminousFlux, OfAllTypesExceptSun) {
    Light light;
    light.intensity = 2;
    EXPECT_NEAR(luminous_flux(light), 8 * std::numbers::pi, 1e-5);
    light.kind = Light::Kind::spot;
    light.outer_cone_radians = float(std::numbers::pi / 2); // half the sphere, with a falloff of cos^2
    EXPECT_NEAR(luminous_flux(light), 4 * std::numbers::pi / 3, 1e-4);
    light.kind = Light::Kind::rectangle;
    light.width = 2, light.height = 3;
    EXPECT_NEAR(luminous_flux(light), 12 * std::numbers::pi, 1e-4);
    light.two_sided = true;
    EXPECT_NEAR(luminous_flux(light), 24 * std::numbers::pi, 1e-4);
}

TEST(NewLight, DisplaysAWhiteSurfaceAtThePivotAsWhite) {
    View view;
    view.position = {3, 1, 8};
    view.pivot_distance = 6;
    for (const Light::Kind kind : kinds) {
        for (const float exposure : {0.f, -3.f, 5.f}) {
            const AddLight add = new_light(kind, view, placement_around_subject({}, view, {}), exposure);
            const Vec3d towards = pivot(view) - to_double(add.node.local.translation);
            const double luminance = illuminance(add.light, length(towards)) / std::numbers::pi;
            EXPECT_NEAR(luminance * std::exp2(exposure), 1, 1e-4);
            const Vec3d forward = rotate(add.node.local.rotation, {0, 0, -1});
            EXPECT_NEAR(dot(forward, normalize(towards)), 1, 1e-6) << "aimed at the pivot";
        }
    }
}

// The view of a sphere of radius 1 at the origin.
View view_of_subject() {
    View view;
    view.position = {0, 1, 5};
    view.rotation = looking_along({0, -1, -5});
    view.pivot_distance = float(std::hypot(1.0, 5.0));
    return view;
}

TEST(NewLight, KeyFillAndRimAreAroundTheSubjectWithoutOverlap) {
    Bounds subject;
    subject.include({-1, -1, -1});
    subject.include({1, 1, 1});
    Project project;
    project.scene.view = view_of_subject();
    std::vector<LightPlacement> spots;
    for (int i = 0; i < 12; ++i) {
        const LightPlacement spot = placement_around_subject(project.scene, project.scene.view, subject);
        const double outside = std::max({std::abs(spot.position.x), std::abs(spot.position.y), std::abs(spot.position.z)});
        EXPECT_GT(outside, 1) << "in the subject";
        const AddLight add = new_light(Light::Kind::rectangle, project.scene.view, spot, 0);
        for (const LightPlacement& other : spots)
            EXPECT_GT(length(spot.position - other.position), std::hypot(add.light.width, add.light.height)) << "the squares may overlap";
        spots.push_back(spot);
        const auto next = blush::apply(project, Edit{add});
        ASSERT_TRUE(next);
        project = *next;
    }
    EXPECT_GT(spots[0].position.x, 0.3) << "the key from the right";
    EXPECT_GT(spots[0].position.z, 0.3) << "and the viewer's side";
    EXPECT_LT(spots[1].position.x, -0.3) << "the fill from the left";
    EXPECT_LT(spots[1].strength, spots[0].strength);
    EXPECT_LT(spots[2].position.z, -0.3) << "the rim from behind";
}

// A small screen stands beside the pivot, on the way to the key light: lights go where there is room, not into the gap.
TEST(NewLight, AvoidsTheGapBeforeAnObjectThatStandsClose) {
    Project project;
    Scene& scene = project.scene;
    scene.view = view_of_subject();
    const LightPlacement open = placement_around_subject(scene, scene.view, {});
    const Vec3d towards = normalize(open.position - open.target);
    const Vec3d right = normalize(cross(Vec3d{0, 1, 0}, towards)), up = cross(towards, right);
    Geometry screen;
    for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        screen.positions.push_back(to_float(open.target + towards * 0.02 + (right * x + up * y) * 0.02));
    screen.indices = {0, 2, 1, 0, 3, 2}; // faces the pivot
    Node node;
    node.mesh = scene.meshes.add({"Screen", {{std::make_shared<const Geometry>(screen), {}}}});
    scene.nodes.add(node);
    const LightPlacement spot = placement_around_subject(scene, scene.view, world_bounds(scene));
    EXPECT_GT(length(spot.position - spot.target), 0.4 * length(open.position - open.target));
}

// A box open towards the viewer with walls facing inwards, and a shell around the pivot.
TEST(NewLight, StaysInARoomThatIsSeenFromOutside) {
    const auto quad = [](Scene& scene, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        Geometry g;
        g.positions = {a, b, c, d};
        g.indices = {0, 1, 2, 0, 2, 3};
        Node node;
        node.mesh = scene.meshes.add({"Wall", {{std::make_shared<const Geometry>(g), {}}}});
        scene.nodes.add(node);
    };
    Project project;
    Scene& scene = project.scene;
    quad(scene, {-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}); // floor, facing up
    quad(scene, {-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1});     // ceiling
    quad(scene, {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}); // back
    quad(scene, {-1, -1, 1}, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}); // left
    quad(scene, {1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1});     // right
    for (const float z : {-0.1f, 0.1f})                              // a plate about the pivot, facing outwards
        z > 0 ? quad(scene, {-0.1f, -0.1f, z}, {0.1f, -0.1f, z}, {0.1f, 0.1f, z}, {-0.1f, 0.1f, z})
              : quad(scene, {-0.1f, 0.1f, z}, {0.1f, 0.1f, z}, {0.1f, -0.1f, z}, {-0.1f, -0.1f, z});
    scene.view = view_of_subject();
    for (int i = 0; i < 9; ++i) {
        const LightPlacement spot = placement_around_subject(scene, scene.view, world_bounds(scene));
        EXPECT_LT(std::max({std::abs(spot.position.x), std::abs(spot.position.y), -spot.position.z}), 1)
            << "light " << i << " is behind a wall";
        const auto next = blush::apply(project, Edit{new_light(Light::Kind::point, scene.view, spot, 0)});
        ASSERT_TRUE(next);
        project = *next;
    }
    const LightPlacement low = placement_above_surface(scene, scene.view, {{0.5, 0.9, 0}, {0, 1, 0}, {}});
    EXPECT_LT(low.position.y, 1) << "under the ceiling";
}

TEST(NewLight, LightsTheSurfaceUnderTheCursorFromTheViewersSide) {
    const View view = view_of_subject();
    const SurfacePoint surface{{0.2, 1, 0}, {0, 1, 0}, {}};
    const LightPlacement spot = placement_above_surface({}, view, surface);
    EXPECT_GT(dot(spot.position - surface.position, surface.normal), 0.1);
    EXPECT_EQ(spot.target, surface.position);
    const LightPlacement behind = placement_above_surface({}, view, {{0.2, 0, 0}, {0, -1, 0}, {}});
    EXPECT_GT(behind.position.y, 0) << "a back face is lit on the visible side";
}

TEST(Heading, KnownDirections) {
    EXPECT_NEAR(heading_of({0, 0, -1}).heading, 0, 1e-4);
    EXPECT_NEAR(heading_of({1, 0, 0}).heading, 90, 1e-4);
    EXPECT_NEAR(heading_of({0, -1, 0}).tilt, -90, 1e-4);
}

TEST(Heading, RoundTrips) {
    for (const Vec3d& d : {Vec3d{1, 2, 3}, Vec3d{-1, -0.2, 0.4}, Vec3d{0.1, 0.9, -3}, Vec3d{0, 1, 0}}) {
        const Vec3d back = direction_of(heading_of(d));
        EXPECT_NEAR(dot(back, normalize(d)), 1, 1e-6);
    }
}

// The roll is measured by the tilt of the light's X axis.
TEST(Heading, TurnsAboutTheVerticalWithoutRoll) {
    for (const Vec3d& euler :
         {Vec3d{0, 0, 0}, Vec3d{-40, 25, 0}, Vec3d{10, 40, 25}, Vec3d{-90, 0, 0}, Vec3d{-90, 0, 70}, Vec3d{89.5, 10, 0}}) {
        const Quat start = from_euler_degrees(euler);
        Quat rotation = start;
        const Heading first = heading_of_rotation(start);
        for (int step = 1; step <= 72; ++step) {
            Heading wanted = heading_of_rotation(rotation);
            wanted.heading += 5;
            rotation = with_heading(rotation, wanted);
            EXPECT_NEAR(heading_of_rotation(rotation).tilt, first.tilt, 1e-2);
            EXPECT_NEAR(rotate(rotation, {1, 0, 0}).y, rotate(start, {1, 0, 0}).y, 1e-4) << "it rolls";
        }
        const Vec3d back = rotate(rotation, {1, 0, 0}), was = rotate(start, {1, 0, 0});
        EXPECT_NEAR(dot(back, was), 1, 1e-4) << "a full turn changes nothing";
    }
}

TEST(Heading, TiltGoesThroughStraightDownAndBack) {
    const Quat start = with_heading({}, {120, -30});
    const Quat down = with_heading(start, {120, -90});
    EXPECT_NEAR(heading_of_rotation(down).heading, 120, 1e-2);
    const Quat back = with_heading(down, {heading_of_rotation(down).heading, -30});
    for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
        EXPECT_NEAR(dot(rotate(back, axis), rotate(start, axis)), 1, 1e-5);
}

TEST(TurnedTo, PointsThereAndKeepsTheRoll) {
    const Quat start = from_euler_degrees({10, 40, 25});
    for (const Vec3d& d : {Vec3d{1, 2, 3}, Vec3d{0, -1, 0}, rotate(start, {0, 0, -1}), rotate(start, {0, 0, 1})}) {
        const Vec3d forward = rotate(turned_to(start, d), {0, 0, -1});
        EXPECT_NEAR(dot(forward, normalize(d)), 1, 1e-6);
    }
    // The shortest rotation does not change its own axis.
    const Vec3d target{1, 2, 3}, axis = normalize(cross(rotate(start, {0, 0, -1}), target));
    const Vec3d local = rotate(Quat{-start.x, -start.y, -start.z, start.w}, axis);
    EXPECT_NEAR(dot(rotate(turned_to(start, target), local), axis), 1, 1e-6);
}

} // namespace
} // namespace blush::TEST_FILE
