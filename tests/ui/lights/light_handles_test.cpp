// Handles that resize lights: the dragged point stays under the mouse.
#include "core/math.h"
#include "scene/affine.h"
#include "ui/lights/light_handles.h"
#include "ui/lights/light_outline.h"
#include "ui/lights/light_tools.h"
#include "ui/transform/rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

View view_from(const Vec3d& eye) {
    View view;
    view.position = to_float(eye);
    view.rotation = looking_along(-eye);
    view.lens.yfov_radians = 0.8f;
    return view;
}

struct Seen {
    Projection projection;
    LightInView sight;

    Seen(const Light& light, const Vec3d& eye, const Vec3d& forward = {0.3, -1, -0.4}, const Vec3& scale = {1, 1, 1})
        : projection(view_from(eye), 1.5) {
        Transform t;
        t.rotation = looking_along(forward);
        t.scale = scale;
        sight = {light, to_affine(t), t.rotation, 1, 0.1};
    }
    Vec3d grip(Handle handle) const {
        const auto handles = size_handles(sight, projection);
        const auto it = std::ranges::find(handles, handle, &SizeHandle::handle);
        EXPECT_NE(it, handles.end());
        return it->grip;
    }
    ViewRay ray_at(const Vec3d& p) const {
        const auto at = projection.project(p);
        return projection.ray(at->u, at->v);
    }
    Light dragged(Handle handle, const Vec3d& to) const { return resized(sight, handle, projection, ray_at(grip(handle)), ray_at(to)); }
};

constexpr Vec3d eyes[] = {{0.5, 1, 8}, {5, 4, 3}, {-6, 1, 1}, {2, -5, 4}};

Light of_kind(Light::Kind kind) {
    Light light;
    light.kind = kind;
    light.width = 2;
    light.height = 1;
    light.radius = 0.6f;
    light.outer_cone_radians = 0.6f;
    light.inner_cone_radians = 0.3f;
    light.angle_radians = 0.1f;
    light.spread_radians = 1.2f;
    return light;
}

// Dragging a handle to its position for another size gives that size: for each size and side, with a scaled node.
TEST(SizeHandles, FollowTheMouse) {
    struct Case {
        Light::Kind kind;
        Handle handle;
        float Light::*field;
        float wanted;
    };
    const Case cases[] = {{Light::Kind::rectangle, Handle::width, &Light::width, 3.1f},
                          {Light::Kind::rectangle, Handle::height, &Light::height, 0.7f},
                          {Light::Kind::disk, Handle::radius, &Light::radius, 1.3f},
                          {Light::Kind::sphere, Handle::radius, &Light::radius, 0.9f},
                          {Light::Kind::point, Handle::radius, &Light::radius, 0.3f},
                          {Light::Kind::spot, Handle::outer_cone, &Light::outer_cone_radians, 1.0f},
                          {Light::Kind::spot, Handle::outer_cone, &Light::outer_cone_radians, 0.4f},
                          {Light::Kind::spot, Handle::inner_cone, &Light::inner_cone_radians, 0.5f},
                          {Light::Kind::spot, Handle::radius, &Light::radius, 0.4f},
                          {Light::Kind::rectangle, Handle::spread, &Light::spread_radians, 2.0f},
                          {Light::Kind::disk, Handle::spread, &Light::spread_radians, 0.7f},
                          {Light::Kind::sun, Handle::sun_angle, &Light::angle_radians, 0.5f}};
    for (const Case& c : cases)
        for (const Vec3d& eye : eyes)
            for (const float scale : {1.f, 2.f}) {
                const Light light = of_kind(c.kind);
                Light other = light;
                other.*c.field = c.wanted;
                const Seen before(light, eye, {0.3, -1, -0.4}, {scale, scale, scale}),
                    after(other, eye, {0.3, -1, -0.4}, {scale, scale, scale});
                const Light dragged = before.dragged(c.handle, after.grip(c.handle));
                EXPECT_NEAR(dragged.*c.field, c.wanted, 2e-3 * c.wanted) << int(c.kind) << " " << int(c.handle) << " scale " << scale;
            }
}

TEST(SizeHandles, ConesSeenAlongTheAxisFollowTheMouse) {
    for (const Vec3d& forward : {Vec3d{0, 0, 1}, Vec3d{0.1, 0.05, 1}, Vec3d{0, 0, -1}}) {
        Light wide = of_kind(Light::Kind::spot);
        wide.outer_cone_radians = 0.9f;
        const Seen before(of_kind(Light::Kind::spot), {0, 0, 8}, forward), after(wide, {0, 0, 8}, forward);
        EXPECT_NEAR(before.dragged(Handle::outer_cone, after.grip(Handle::outer_cone)).outer_cone_radians, 0.9, 2e-3);
    }
}

TEST(SizeHandles, SizesStayInRange) {
    for (const Vec3d& eye : eyes) {
        const Seen panel(of_kind(Light::Kind::rectangle), eye);
        EXPECT_GT(
            panel.dragged(Handle::width, panel.sight.world_from_node.t - (panel.grip(Handle::width) - panel.sight.world_from_node.t) * 2.0)
                .width,
            0);
        const Seen spot(of_kind(Light::Kind::spot), eye);
        const Light narrow = spot.dragged(Handle::outer_cone, rotate(spot.sight.rotation, {0, 0, -1}));
        EXPECT_GT(narrow.outer_cone_radians, 0);
        EXPECT_LE(narrow.inner_cone_radians, narrow.outer_cone_radians);
        const Light slit = panel.dragged(Handle::spread, panel.sight.world_from_node.t + rotate(panel.sight.rotation, {0, 0, -1}));
        EXPECT_GT(slit.spread_radians, 0);
        EXPECT_LT(slit.spread_radians, 0.1);
        const Seen ball(of_kind(Light::Kind::point), eye);
        EXPECT_EQ(
            ball.dragged(Handle::radius, ball.sight.world_from_node.t - (ball.grip(Handle::radius) - ball.sight.world_from_node.t) * 2.0)
                .radius,
            0)
            << "a point again";
    }
}

TEST(SizeHandles, KeepTheFluxIfKeepPowerIsSet) {
    Light panel = of_kind(Light::Kind::rectangle);
    panel.intensity = 100;
    for (const bool keep : {false, true}) {
        panel.keep_power = keep;
        Light wide = panel;
        wide.width = 4;
        const Seen before(panel, eyes[0]), after(wide, eyes[0]);
        const Light dragged = before.dragged(Handle::width, after.grip(Handle::width));
        if (keep) {
            EXPECT_NEAR(luminous_flux(dragged), luminous_flux(panel), 1e-3 * luminous_flux(panel));
        } else {
            EXPECT_EQ(dragged.intensity, panel.intensity);
        }
    }
}

TEST(SunDial, IsInvertible) {
    for (const double degrees : {0.0, 0.1, 0.53, 5.0, 60.0, 180.0}) {
        const double radians = degrees * std::numbers::pi / 180;
        EXPECT_NEAR(angle_of_dial(dial_of_angle(radians)), radians, 1e-9);
    }
    EXPECT_GT(dial_of_angle(0.00925), dial_of_angle(0) + 0.5) << "the real sun differs from parallel light";
    EXPECT_EQ(angle_of_dial(-3), 0);
    EXPECT_EQ(angle_of_dial(99), std::numbers::pi);
}

double farthest(const std::vector<WorldLine>& lines, const Vec3d& from) {
    double d = 0;
    for (const WorldLine& l : lines) d = std::max({d, length(l.from - from), length(l.to - from)});
    return d;
}

TEST(LightOutline, ShowsTheSize) {
    Scene scene;
    Node node;
    node.local.scale = {2, 2, 2};
    node.light = scene.lights.add(of_kind(Light::Kind::sphere));
    const Id<Node> id = scene.nodes.add(node);
    const Projection projection(view_from({0, 0, 8}), 1);
    EXPECT_NEAR(farthest(light_outline(scene, id, of_kind(Light::Kind::sphere), projection, 1), {0, 0, 0}), 1.2, 1e-5);
    EXPECT_NEAR(farthest(light_outline(scene, id, of_kind(Light::Kind::rectangle), projection, 0.1), {0, 0, 0}), std::hypot(2, 1), 1e-5);
    EXPECT_NEAR(farthest(light_outline(scene, id, of_kind(Light::Kind::disk), projection, 0.1), {0, 0, 0}), 1.2, 1e-5);
    Light point = of_kind(Light::Kind::point);
    point.radius = 0;
    EXPECT_TRUE(light_outline(scene, id, point, projection, 1).empty());
}

TEST(LightOutline, ConeHasItsAngle) {
    Scene scene;
    Node node;
    node.light = scene.lights.add(of_kind(Light::Kind::spot));
    const Id<Node> id = scene.nodes.add(node);
    const Projection projection(view_from({0, 0, 8}), 1);
    Light spot = of_kind(Light::Kind::spot);
    spot.inner_cone_radians = spot.radius = 0;
    for (const WorldLine& l : light_outline(scene, id, spot, projection, 3))
        EXPECT_NEAR(std::acos(-normalize(l.to).z), spot.outer_cone_radians, 1e-6);
}

} // namespace
} // namespace blush::TEST_FILE
