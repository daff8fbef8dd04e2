// Rows of the Light section for size and cone.
#include "ui/panels/light/fields.h"

#include "scene/lights/light_units.h"

#include <algorithm>
#include <numbers>

namespace blush {
namespace {

NumberStyle length(float reset, const char* tip) { return {.min = 1e-4f, .max = 1e6f, .reset = reset, .unit = "m", .tip = tip}; }

void draw_size(Fields& f, Light& light) {
    switch (light.kind) {
    case Light::Kind::rectangle:
        f.number("Width", light.width, length(1, "Width along the node's X axis, before the node's scale."));
        f.number("Height", light.height, length(1, "Height along the node's Y axis, before the node's scale."));
        break;
    case Light::Kind::disk:
    case Light::Kind::sphere: f.number("Radius", light.radius, length(0.1f, "Radius before the node's scale.")); break;
    case Light::Kind::point:
    case Light::Kind::spot:
        f.number("Radius", light.radius,
                 {.min = 0,
                  .max = 1e6f,
                  .reset = 0,
                  .unit = "m",
                  .step = 0.002f,
                  .tip = "Radius of the emitting sphere. 0 is a point with hard shadows. A larger radius gives softer shadows at the same "
                         "intensity."});
        break;
    case Light::Kind::sun:
        f.angle(
            "Angle", light.angle_radians,
            {.min = 0,
             .max = 180,
             .reset = 0.53f,
             .step = 0.02f,
             .tip =
                 "Angular diameter of the light in the sky. 0 is perfectly parallel light; the real sun has 0.53 degrees, an overcast sky "
                 "far more."});
        break;
    }
    if (is_per_area(light.kind))
        f.checkbox("Keep power", light.keep_power,
                   "Resizing keeps the lumens: a larger light has less luminance. Otherwise it keeps the nits, and a larger light gives "
                   "more light.");
}

void draw_cone(Fields& f, Light& light) {
    const auto angle = [&](const char* name, float& radians, float reset, const char* tip) {
        f.angle(name, radians, {.min = 0, .max = 90, .reset = reset, .bar = true, .tip = tip});
    };
    angle("Cone", light.outer_cone_radians, 45, "Half angle of the outer cone, where the intensity reaches zero.");
    angle("Inner cone", light.inner_cone_radians, 0,
          "Half angle of the inner cone, which has full intensity. Between inner and outer cone it fades.");
    light.inner_cone_radians = std::min(light.inner_cone_radians, light.outer_cone_radians);
}

void draw_panel_sides(Fields& f, Light& light) {
    constexpr float pi_f = std::numbers::pi_v<float>;
    if (f.angle(
            "Spread", light.spread_radians,
            {.min = 0.1f,
             .max = 180,
             .reset = 180,
             .bar = true,
             .tip = "Full angle of the emission, like a softbox with a grid. The lumens stay: a narrower angle is brighter straight ahead. "
                    "180 is a bare panel."}))
        light.spread_radians = std::min(light.spread_radians, pi_f);
    f.checkbox("Two-sided", light.two_sided, "Emit from the back as well.");
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
        f.checkbox("Seen by camera", light.visible_to_camera,
                   "If off, the camera does not see the light itself. Reflections and illumination do not change.");
}

} // namespace blush
