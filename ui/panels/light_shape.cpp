// The light inspector's rows of size and cone.
#include "ui/panels/light_fields.h"

#include "scene/light_units.h"

#include <algorithm>

namespace blush {
namespace {

NumberStyle length(float reset, const char* tip) { return {.min = 1e-4f, .max = 1e6f, .reset = reset, .unit = "m", .tip = tip}; }

void draw_size(Fields& f, Light& light) {
    switch (light.kind) {
    case Light::Kind::rectangle:
        f.number("Width", light.width, length(1, "Along the node's X, before its scale."));
        f.number("Height", light.height, length(1, "Along the node's Y, before its scale."));
        break;
    case Light::Kind::disk:
    case Light::Kind::sphere: f.number("Radius", light.radius, length(0.1f, "Before the node's scale.")); break;
    case Light::Kind::point:
    case Light::Kind::spot:
        f.number("Radius", light.radius,
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
                 .tip = "How wide the light is in the sky. 0 gives perfectly parallel light; the real sun spans 0.53 degrees, an overcast sky "
                        "far more."});
        break;
    }
    if (is_per_area(light.kind))
        f.checkbox("Keep power", light.keep_power,
                   "When it is resized, keep the lumens: a larger light gets dimmer. Otherwise the nits stay, and a larger light gives more.");
}

void draw_cone(Fields& f, Light& light) {
    const auto angle = [&](const char* name, float& radians, float reset, const char* tip) {
        f.angle(name, radians, {.min = 0, .max = 90, .reset = reset, .bar = true, .tip = tip});
    };
    angle("Cone", light.outer_cone_radians, 45, "Half angle at which the light has faded out.");
    angle("Full inside", light.inner_cone_radians, 0, "Half angle up to which the light has its full intensity; between the two it fades.");
    light.inner_cone_radians = std::min(light.inner_cone_radians, light.outer_cone_radians);
}

void draw_panel_sides(Fields& f, Light& light) {
    constexpr float pi_f = 3.1415927f;
    if (f.angle("Spread", light.spread_radians,
                {.min = 0.1f,
                 .max = 180,
                 .reset = 180,
                 .bar = true,
                 .tip = "Full angle that it shines into, as through a grid of slats. The lumens stay: the narrower, the brighter straight ahead. "
                        "180 is a bare panel."}))
        light.spread_radians = std::min(light.spread_radians, pi_f);
    f.checkbox("Two-sided", light.two_sided, "Shine from the back as well.");
}

bool has_size(const Light& light) {
    if (light.kind == Light::Kind::sun) return light.angle_radians > 0;
    return is_per_area(light.kind) || light.radius > 0;
}

} // namespace

void draw_light_shape(Fields& f, Light& light) {
    draw_size(f, light);
    if (light.kind == Light::Kind::spot) draw_cone(f, light);
    if (light.kind == Light::Kind::rectangle || light.kind == Light::Kind::disk) draw_panel_sides(f, light);
    if (has_size(light))
        f.checkbox("Seen by camera", light.visible_to_camera, "Show the light itself. Mirrors show it, and it lights, either way.");
}

} // namespace blush
