#include "ui/viewport/environment_dial.h"

#include "core/math.h"
#include "scene/lights/light_visibility.h"
#include "scene/lights/sun_position.h"
#include "ui/lights/light_tools.h"
#include "ui/window/theme.h"

#include <cmath>
#include <numbers>

namespace blush {
namespace {

// In font sizes, from the image's left and lower edge to the centre; the backdrop in radii.
constexpr float dial_radius = 1.5f, dial_from_edge = 2.4f, dial_backdrop = 1.25f;

} // namespace

ScreenPoint dial_point(const Vec3d& direction, const Vec3d& view_forward) {
    constexpr double degree = std::numbers::pi / 180;
    const Heading to = heading_of(direction), ahead = heading_of(view_forward);
    const double angle = (to.heading - ahead.heading) * degree, radius = 1 - std::max(to.tilt, 0.f) / 90;
    return {float(radius * std::sin(angle)), float(-radius * std::cos(angle))};
}

bool draw_environment_dial(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& seen, bool hovered) {
    const Environment& e = c.scene().environment;
    if (e.kind == Environment::Kind::none) return false;
    const float em = ImGui::GetFontSize(), radius = em * dial_radius, from_edge = em * dial_from_edge, line = std::max(1.f, em / 12);
    const ImVec2 centre{seen.x + from_edge, seen.y + seen.height - from_edge}, mouse = ImGui::GetIO().MousePos;
    const bool under = hovered && std::hypot(mouse.x - centre.x, mouse.y - centre.y) < radius * 1.2f;
    const bool chosen = c.ui.environment_chosen();
    const bool shining = emits_light(e, any_solo(c.scene()));
    const ImU32 color = hue_of(e.color, shining ? 255 : 110);
    const auto at = [&](const Vec3d& direction, float stretch = 1) {
        const ScreenPoint p = dial_point(direction, projection.forward());
        return ImVec2{centre.x + p.x * radius * stretch, centre.y + p.y * radius * stretch};
    };
    draw.AddCircleFilled(centre, radius * dial_backdrop, IM_COL32(20, 20, 20, under ? 210 : 150));
    if (chosen) draw.AddCircle(centre, radius * dial_backdrop, tone::accent, 0, line * 1.5f);
    draw.AddCircle(centre, radius, color, 0, line * 1.5f);
    if (e.kind != Environment::Kind::constant) {
        // Where north is, or the centre of the panorama.
        const Vec3d mark = direction_of(Heading{-e.rotation_degrees, 0});
        draw.AddLine(at(mark, 0.65f), at(mark), color, line * 2);
    }
    if (e.kind == Environment::Kind::sky) {
        const SunPosition sun = sun_position(e.sky);
        const Vec3d towards = direction_of(Heading{float(sun.azimuth) - e.rotation_degrees, float(sun.elevation)});
        draw.AddCircleFilled(at(towards), radius * 0.18f, sun.elevation > 0 ? tone::light : tone::dim_text);
    }
    if (!e.lights_scene)
        draw.AddLine({centre.x - radius * 0.7f, centre.y + radius * 0.7f}, {centre.x + radius * 0.7f, centre.y - radius * 0.7f},
                     tone::failure, line * 2);
    c.ui.probe.record("Environment dial", {centre.x - radius, centre.y - radius, 2 * radius, 2 * radius});
    const bool pressed = under && ImGui::IsMouseClicked(ImGuiMouseButton_Left);
    if (pressed) {
        c.ui.select({});
        c.ui.tab = InspectorTab::environment;
    }
    return pressed;
}

float environment_dial_width(const PanelContext& c) {
    const bool shown = c.ui.settings.overlays && c.scene().environment.kind != Environment::Kind::none;
    return shown ? ImGui::GetFontSize() * (dial_from_edge + dial_radius * dial_backdrop) : 0;
}

} // namespace blush
