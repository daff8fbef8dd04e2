// Light section: type and direction. The other files of this folder draw intensity, size, distribution and linking.
#include "ui/lights/light_tools.h"
#include "ui/lights/multi_edit_apply.h"
#include "ui/panels/light/fields.h"
#include "ui/panels/panels.h"
#include "ui/transform/gizmo.h"
#include "ui/transform/rotation.h"
#include "ui/viewport/orbit_camera.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include "core/math.h"
#include "scene/lights/light_units.h"

#include <cmath>

namespace blush {
namespace {

constexpr const char* kinds[] = {"Point", "Spot", "Sun", "Rectangle", "Disk", "Sphere"};

void draw_kind(Fields& f, PanelContext& c, Light& light, const Vec3d& position) {
    int kind = int(light.kind);
    if (!f.choice("Type", kind, kinds, "Type of the light. A change keeps the illuminance at the view's pivot.")) return;
    const double distance = std::max(length(pivot(c.scene().view) - position), 1e-3);
    light = converted(light, Light::Kind(kind), distance);
}

// Factor by which the node's scale enlarges the area of a light.
double area_scale(const Affined& world, Light::Kind kind) {
    if (kind == Light::Kind::sphere) return std::pow(std::abs(determinant(world)), 2.0 / 3);
    return length(cross(world.x, world.y));
}

void draw_direction(Fields& f, PanelContext& c, Id<Node> id, const Light& light) {
    const Quat rotation = world_rotation(c.scene(), id);
    Heading heading = heading_of_rotation(rotation);
    f.number("Heading", heading.heading,
             {.min = -360,
              .max = 360,
              .reset = 0,
              .unit = "°",
              .step = 0.5f,
              .tip = light.kind == Light::Kind::sun
                         ? "Compass direction in which the light travels: degrees clockwise from -Z, seen from above."
                         : "Compass direction of the emission: degrees clockwise from -Z, seen from above."});
    f.number("Tilt", heading.tilt,
             {.min = -90,
              .max = 90,
              .reset = -45,
              .unit = "°",
              .step = 0.25f,
              .bar = true,
              .tip = "Angle of the emission above the horizon: -90 is straight down. A sun 30 degrees above the horizon has a "
                     "tilt of -30."});
    if (!f.changed()) return;
    Node node = *c.scene().nodes.find(id);
    node.local = rotated_to(c.scene(), id, with_heading(rotation, heading));
    c.apply(SetNode{id, node}, f.gesture());
}

} // namespace

void draw_light_panel(PanelContext& c, Id<Node> id) {
    const Node* node = c.scene().nodes.find(id);
    const Light* record = node ? c.scene().lights.find(node->light) : nullptr;
    if (!record || !section(c.ui, "Light")) return;
    const Id<Light> light_id = node->light;
    Light light = *record;
    if (const std::string several = about_selected_lights(c); !several.empty()) quiet_text(several);
    {
        Fields f(c.ui, "Light");
        f.checkbox("On", light.enabled, "A light that is off emits nothing and costs no render time.");
        const Affined world = world_from_node(c.scene(), id);
        draw_kind(f, c, light, world.t);
        draw_light_strength(f, light, area_scale(world, light.kind));
        const Light before = light;
        draw_light_shape(f, light);
        light = with_same_power(before, light);
        draw_light_distribution(f, c, light);
        if (f.changed()) set_light(c, light_id, light, f.gesture());
    }
    if (has_direction(light.kind) || light.ies) {
        Fields f(c.ui, "Direction");
        draw_direction(f, c, id, light);
    }
}

} // namespace blush
