// Rows of the Light section for intensity and colour.
#include "ui/panels/light/fields.h"

#include "core/srgb.h"
#include "scene/lights/color_temperature.h"
#include "scene/lights/light_units.h"
#include "ui/widgets/value_text.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace blush {
namespace {

constexpr Light::Unit units[] = {Light::Unit::watt, Light::Unit::lumen, Light::Unit::candela,
                                 Light::Unit::lux,  Light::Unit::nits,  Light::Unit::ev};

// By unit; `own` is never shown.
struct UnitText {
    const char *menu, *suffix, *tip;
};
UnitText text_of(Light::Unit unit, Light::Kind kind) {
    const bool is_sun = kind == Light::Kind::sun;
    switch (unit) {
    case Light::Unit::watt:
        return {"Watt (radiant)", "W",
                "Radiant power in watts; 1 W counts as 683 lm, as other programs exchange it. It is not the electrical power: a 60 W bulb "
                "emits about 1 W of this."};
    case Light::Unit::lumen: return {"Lumen", "lm", "Luminous flux: all emitted light, as printed on lamps. A 60 W bulb gives 800 lm."};
    case Light::Unit::candela:
        return {"Candela", "cd",
                "Luminous intensity straight ahead: equals the lux on a surface one metre away. Lux fall with the square of the distance."};
    case Light::Unit::lux:
        return is_sun ? UnitText{"Lux", "lx",
                                 "Illuminance of a surface that faces the light. The sun at noon gives about 100 000 lx, an overcast sky "
                                 "10 000, an "
                                 "office 500."}
                      : UnitText{"Lux at 1 m", "lx",
                                 "Illuminance of a surface that faces the light one metre away, as if the light were small."};
    case Light::Unit::nits:
        return is_sun ? UnitText{"Nits", "nits", "Luminance of the sun's disk. The sun at noon has 1.6e9 nits."}
                      : UnitText{
                            "Nits", "nits",
                            "Luminance of the surface in candela per square metre. A larger light of the same luminance gives more light."};
    case Light::Unit::ev:
        return {"EV", "EV",
                "Exposure value at ISO 100 that shows the light, or a surface it lights at one metre, as medium grey. One EV more doubles "
                "the light."};
    case Light::Unit::own: break;
    }
    return {"", "", ""};
}

// The unit shown: the user's choice, if this kind of light has it.
Light::Unit shown_unit(const Light& light) {
    return light.unit == Light::Unit::own || !has_unit(light, light.unit) ? own_unit(light.kind) : light.unit;
}

void draw_intensity(Fields& f, Light& light, double area_scale) {
    std::vector<Light::Unit> choices;
    std::vector<const char*> names;
    for (const Light::Unit unit : units)
        if (has_unit(light, unit)) {
            choices.push_back(unit);
            names.push_back(text_of(unit, light.kind).menu);
        }
    Light::Unit unit = shown_unit(light);
    int index = int(std::ranges::find(choices, unit) - choices.begin());
    if (f.choice("Unit", index, names, "Unit of the intensity. The light does not change.")) light.unit = unit = choices[size_t(index)];

    const UnitText text = text_of(unit, light.kind);
    const bool is_ev = unit == Light::Unit::ev;
    constexpr float min_ev = -40;
    float value = float(in_unit(light, unit, area_scale));
    if (is_ev) value = std::max(value, min_ev);
    NumberStyle style{.min = 0, .max = 1e12f, .reset = 1, .unit = text.suffix, .tip = text.tip};
    if (is_ev) style = {.min = min_ev, .max = 40, .reset = 0, .unit = text.suffix, .step = 0.02f, .tip = text.tip, .format = "%.2f"};
    if (f.number("Intensity", value, style)) light.intensity = intensity_of(light, unit, double(value), area_scale);
    if (light.kind != Light::Kind::sun && unit != Light::Unit::lumen)
        f.info("", shown_number(luminous_flux(light, area_scale)) + " lm in all");
}

// A coloured stripe below the last field.
void draw_stripe(const Vec3& color) {
    const float brightest = std::max({color.x, color.y, color.z, 1e-6f});
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const float stripe = std::max(2.f, ImGui::GetFontSize() / 6);
    const auto encoded = [&](float x) { return int(255 * srgb_from_linear(x / brightest)); };
    ImGui::GetWindowDrawList()->AddRectFilled({low.x, high.y - stripe}, high,
                                              IM_COL32(encoded(color.x), encoded(color.y), encoded(color.z), 255),
                                              ImGui::GetStyle().FrameRounding, ImDrawFlags_RoundCornersBottom);
}

void draw_color(Fields& f, Light& light) {
    f.checkbox("Temperature", light.use_temperature,
               "Use the colour of a black body, as specified for lamps and daylight. The intensity does not change.");
    if (light.use_temperature) {
        f.number("Kelvin", light.kelvin,
                 {.min = 1000,
                  .max = 15000,
                  .reset = 6500,
                  .unit = "K",
                  .bar = true,
                  .tip = "Temperature of the black body: candle 1900 K, bulb 2700 K, noon sun 5500 K, blue sky 10 000 K.",
                  .format = "%.0f"});
        draw_stripe(black_body_color(light.kelvin, light.green_tint));
        f.number(
            "Green tint", light.green_tint,
            {.min = -0.05f,
             .max = 0.05f,
             .reset = 0,
             .step = 0.0002f,
             .tip =
                 "Distance from the colours of black bodies in CIE 1960 uv (Duv): above 0 greenish, as some fluorescent tubes are, below 0 "
                 "magenta. White lamps are within 0.006.",
             .format = "%+.4f"});
    }
    f.color(light.use_temperature ? "Tint" : "Colour", light.color, {1, 1, 1},
            "Linear RGB (Rec.709) factor of the intensity, like a colour gel in front of the lamp.");
}

} // namespace

void draw_light_strength(Fields& f, Light& light, double area_scale) {
    draw_intensity(f, light, area_scale);
    draw_color(f, light);
}

} // namespace blush
