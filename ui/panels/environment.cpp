// Environment panel: the light from all directions around the scene (constant, image or sky).
#include "core/math.h"
#include "scene/lights/sky_model.h"
#include "scene/lights/sun_position.h"
#include "ui/panels/panels.h"
#include "ui/widgets/widgets.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace blush {
namespace {

void draw_image(Fields& f, PanelContext& c, const Environment& e) {
    f.info("Image",
           fmt::format("{}{}", std::filesystem::path(e.file).filename().string(),
                       e.image ? fmt::format("  {} × {}", e.image->width, e.image->height) : ""),
           e.file.c_str());
    if (f.button("Choose image...", "A panorama in latitude and longitude: Radiance .hdr or OpenEXR .exr."))
        c.ui.commands.push_back(Command::environment);
}

void whole_number(Fields& f, const char* label, int32_t& value, int min, int max, int reset, const char* tip) {
    int64_t number = value;
    if (f.integer(label, number, min, max, reset, tip)) value = int32_t(number);
}

void draw_place_and_time(Fields& f, Sky& sky) {
    f.number("Latitude", sky.latitude_degrees,
             {.min = -90, .max = 90, .reset = 52, .unit = "°", .step = 0.1f, .tip = "Degrees north of the equator.", .format = "%.3f"});
    f.number("Longitude", sky.longitude_degrees,
             {.min = -180, .max = 180, .reset = 5, .unit = "°", .step = 0.1f, .tip = "Degrees east of Greenwich.", .format = "%.3f"});
    whole_number(f, "Year", sky.year, 1900, 2100, 2026, "Gregorian calendar.");
    whole_number(f, "Month", sky.month, 1, 12, 6, "1 is January.");
    whole_number(f, "Day", sky.day, 1, 31, 21, "Day of the month.");
    f.number("Hour (UTC)", sky.utc_hours,
             {.min = 0,
              .max = 24,
              .reset = 12,
              .unit = "h",
              .bar = true,
              .tip = "Universal time in hours. Solar time is this plus longitude / 15.",
              .format = "%.2f"});
    const SunPosition sun = sun_position(sky);
    f.info("Sun", fmt::format("{:.2f}° up, {:.2f}° from north", sun.elevation, sun.azimuth));
}

void draw_angles(Fields& f, Sky& sky) {
    f.number(
        "Elevation", sky.elevation_degrees,
        {.min = -10, .max = 90, .reset = 35, .unit = "°", .bar = true, .tip = "Elevation of the sun above the horizon.", .format = "%.1f"});
    f.number("Azimuth", sky.azimuth_degrees,
             {.min = 0,
              .max = 360,
              .reset = 135,
              .unit = "°",
              .bar = true,
              .tip = "Azimuth of the sun, clockwise from north as seen from above. North is -Z, east is +X.",
              .format = "%.1f"});
}

void draw_sky(Fields& f, Sky& sky) {
    f.checkbox("By place and time", sky.by_place_and_time,
               "Compute the sun's direction from place and time. Otherwise set elevation and azimuth directly.");
    if (sky.by_place_and_time)
        draw_place_and_time(f, sky);
    else
        draw_angles(f, sky);
    f.number("Turbidity", sky.turbidity,
             {.min = 1.7f,
              .max = 10,
              .reset = 3,
              .bar = true,
              .tip = "How hazy the air is: 2 is very clear, 3 clear, 6 a warm moist day, 10 hazy. (Preetham, Shirley and Smits 1999.)",
              .format = "%.2f"});
    f.number("Ground albedo", sky.ground_albedo,
             {.min = 0,
              .max = 1,
              .reset = 0.3f,
              .bar = true,
              .tip = "Fraction of the daylight that the ground below the horizon reflects.",
              .format = "%.2f"});
    f.checkbox("Sun", sky.sun_disk, "Add the sun disk, with its light attenuated by the atmosphere.");
    const SkyModel model(sky);
    f.info("Skylight", fmt::format("{:.3g} klx", luminance(model.sky_illuminance()) / 1000),
           "Illuminance of the sky without the sun, on a horizontal surface.");
    f.info("Sunlight", fmt::format("{:.3g} klx", luminance(model.sun_illuminance()) / 1000),
           "Illuminance of the sun without the sky, on a surface that faces it.");
}

} // namespace

void draw_environment_panel(PanelContext& c) {
    static constexpr const char* kinds[] = {"None", "Constant", "Image", "Sky"};
    Environment e = c.scene().environment;
    Fields f(c.ui, "Environment");
    int kind = int(e.kind);
    if (f.choice("Type", kind, kinds, "Light from all directions: none, one colour, a panorama image (HDRI), or a clear sky.")) {
        if (Environment::Kind(kind) == Environment::Kind::image && !e.image)
            c.ui.commands.push_back(Command::environment);
        else
            e.kind = Environment::Kind(kind);
        c.ui.meter_exposure |=
            e.kind != c.scene().environment.kind && (e.kind == Environment::Kind::image || e.kind == Environment::Kind::sky);
    }
    if (e.kind == Environment::Kind::image) draw_image(f, c, e);
    if (e.kind == Environment::Kind::sky) draw_sky(f, e.sky);
    if (e.kind != Environment::Kind::none) {
        const bool constant = e.kind == Environment::Kind::constant;
        f.number("Intensity", e.intensity,
                 {.min = 0,
                  .max = 1e9f,
                  .reset = 1,
                  .unit = constant ? "nits" : "×",
                  .tip = constant ? "Luminance of the environment for a white colour."
                                  : "Multiplies the image or the sky. 1 takes their values as nits; a day's are thousands."});
        f.color(constant ? "Colour" : "Tint", e.color, {1, 1, 1},
                constant ? "Linear RGB (Rec.709) of the environment." : "Linear RGB (Rec.709) factor of the environment.");
        if (!constant)
            f.number("Rotation", e.rotation_degrees,
                     {.min = -180,
                      .max = 180,
                      .reset = 0,
                      .unit = "°",
                      .bar = true,
                      .tip = "Rotation about the vertical axis.",
                      .format = "%.1f"});
        f.checkbox("Seen by camera", e.visible_to_camera, "Show the environment behind the scene.");
        f.checkbox("Lights the scene", e.lights_scene,
                   "If off, the environment is only a backdrop that the camera sees. The sun of a sky is then off as well.");
    }
    if (f.changed()) c.apply(SetEnvironment{e}, f.gesture());
}

} // namespace blush
