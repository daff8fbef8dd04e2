// Light: kind, brightness in its unit, colour or temperature, size.
#include "ui/gizmo.h"
#include "ui/light_tools.h"
#include "ui/orbit_camera.h"
#include "ui/panels/panels.h"
#include "ui/rotation.h"
#include "ui/selected_lights.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include "scene/color_temperature.h"

#include <fmt/format.h>

namespace blush {
namespace {

constexpr const char* kinds[] = {"Point", "Spot", "Sun", "Rectangle", "Disk", "Sphere"};

const char* intensity_tip(Light::Kind kind) {
    switch (kind) {
    case Light::Kind::sun:
        return "Illuminance in lux on a surface that faces the light. The sun at noon gives about 100 000 lx, an overcast sky 10 000, an "
               "office 500.";
    case Light::Kind::rectangle:
    case Light::Kind::disk:
    case Light::Kind::sphere:
        return "Luminance in nits (candela per square metre) of the surface itself. A larger light of the same luminance gives more "
               "light.";
    default:
        return "Luminous intensity in candela: the illuminance in lux on a surface that faces the light one metre away. It falls with the "
               "square of the distance.";
    }
}

void draw_kind(Fields& f, PanelContext& c, Light& light, const Vec3d& position) {
    int kind = int(light.kind);
    if (!f.choice("Type", kind, kinds, "What shape the light has. The new kind lights the view's pivot as brightly as the old one."))
        return;
    const double distance = std::max(length(pivot(c.scene().view) - position), 1e-3);
    light = converted(light, Light::Kind(kind), distance);
}

void draw_brightness(Fields& f, Light& light) {
    f.number("Intensity", light.intensity,
             {.min = 0, .max = 1e12f, .reset = 1, .unit = intensity_unit(light.kind), .tip = intensity_tip(light.kind)});
    if (light.kind != Light::Kind::sun) f.info("", fmt::format("{:.4g} lm in all", luminous_flux(light)));
    f.checkbox("Temperature", light.use_temperature,
               "Take the colour of a glowing black body, as lamps and daylight are described. The brightness stays.");
    if (light.use_temperature) {
        f.number("Kelvin", light.kelvin,
                 {.min = 1000,
                  .max = 15000,
                  .reset = 6500,
                  .unit = "K",
                  .bar = true,
                  .tip = "Temperature of the black body: candle 1900 K, bulb 2700 K, noon sun 5500 K, blue sky 10 000 K.",
                  .format = "%.0f"});
        Vec3 glow = black_body_color(light.kelvin);
        const float brightest = std::max({glow.x, glow.y, glow.z});
        const ImVec2 high = ImGui::GetItemRectMax();
        const float stripe = std::max(2.f, ImGui::GetFontSize() / 6);
        const auto encoded = [&](float x) { return int(255 * std::pow(x / brightest, 1 / 2.2f)); };
        ImGui::GetWindowDrawList()->AddRectFilled({ImGui::GetItemRectMin().x, high.y - stripe}, high,
                                                  IM_COL32(encoded(glow.x), encoded(glow.y), encoded(glow.z), 255),
                                                  ImGui::GetStyle().FrameRounding, ImDrawFlags_RoundCornersBottom);
    }
    f.color(light.use_temperature ? "Tint" : "Colour", light.color, {1, 1, 1},
            "Linear RGB (Rec.709) that multiplies the intensity, as a gel before the lamp does.");
}

void draw_size(Fields& f, Light& light) {
    switch (light.kind) {
    case Light::Kind::point:
        f.number(
            "Radius", light.radius,
            {.min = 0,
             .max = 1e6f,
             .reset = 0,
             .unit = "m",
             .step = 0.002f,
             .tip = "Radius of the glowing sphere. 0 is a point with hard shadows; a larger sphere of the same intensity softens them."});
        break;
    case Light::Kind::sun:
        f.angle("Angle", light.angle_radians,
                {.min = 0,
                 .max = 180,
                 .reset = 0.53f,
                 .step = 0.02f,
                 .tip = "How wide the light is in the sky. 0 gives perfectly parallel light; the real sun spans 0.53 degrees, an overcast "
                        "sky far more."});
        break;
    case Light::Kind::spot: {
        const auto angle = [&](const char* name, float& radians, float reset, const char* tip) {
            f.angle(name, radians, {.min = 0, .max = 90, .reset = reset, .bar = true, .tip = tip});
        };
        angle("Cone", light.outer_cone_radians, 45, "Half angle at which the light has faded out.");
        angle("Full inside", light.inner_cone_radians, 0,
              "Half angle up to which the light has its full intensity; between the two it fades.");
        light.inner_cone_radians = std::min(light.inner_cone_radians, light.outer_cone_radians);
        break;
    }
    case Light::Kind::disk:
    case Light::Kind::sphere:
        f.number("Radius", light.radius,
                 {.min = 1e-4f,
                  .max = 1e6f,
                  .reset = 0.1f,
                  .unit = "m",
                  .tip = "Before the node's scale. The luminance stays, so a larger light gives more."});
        if (light.kind == Light::Kind::disk) f.checkbox("Two-sided", light.two_sided, "Shine from the back as well.");
        break;
    case Light::Kind::rectangle:
        f.number("Width", light.width,
                 {.min = 1e-4f,
                  .max = 1e6f,
                  .reset = 1,
                  .unit = "m",
                  .tip = "Along the node's X, before its scale. The luminance stays, so a wider light gives more."});
        f.number("Height", light.height,
                 {.min = 1e-4f,
                  .max = 1e6f,
                  .reset = 1,
                  .unit = "m",
                  .tip = "Along the node's Y, before its scale. The luminance stays, so a higher light gives more."});
        f.checkbox("Two-sided", light.two_sided, "Shine from the back as well.");
        break;
    }
}

void draw_direction(Fields& f, PanelContext& c, Id<Node> id, const Light& light) {
    const Quat rotation = world_rotation(c.scene(), id);
    Heading heading = heading_of(rotate(rotation, {0, 0, -1}));
    f.number("Heading", heading.heading,
             {.min = -360,
              .max = 360,
              .reset = 0,
              .unit = "°",
              .step = 0.5f,
              .tip = light.kind == Light::Kind::sun
                         ? "Compass direction in which the light travels, clockwise from -Z as seen from above."
                         : "Compass direction in which the light shines, clockwise from -Z as seen from above."});
    f.number("Tilt", heading.tilt,
             {.min = -90,
              .max = 90,
              .reset = -45,
              .unit = "°",
              .step = 0.25f,
              .bar = true,
              .tip = "Angle above the horizon in which the light shines: -90 is straight down. A sun that stands 30 degrees high has a "
                     "tilt of -30."});
    if (!f.changed()) return;
    Node node = *c.scene().nodes.find(id);
    node.local = rotated_to(c.scene(), id, turned_to(rotation, direction_of(heading)));
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
        f.checkbox("On", light.enabled, "A light that is off gives no light and costs no time.");
        draw_kind(f, c, light, world_from_node(c.scene(), id).t);
        draw_brightness(f, light);
        draw_size(f, light);
        if (f.changed()) set_light(c, light_id, light, f.gesture());
    }
    if (has_direction(light.kind)) {
        Fields f(c.ui, "Direction");
        draw_direction(f, c, id, light);
    }
}

} // namespace blush
