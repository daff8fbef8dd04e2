#include "ui/widgets/polar_plot.h"

#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <numbers>

namespace blush {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Angular attenuation of KHR_lights_punctual.
double cone_factor(const Light& light, double cosine) {
    if (light.kind != Light::Kind::spot) return 1;
    const double inner = std::cos(double(light.inner_cone_radians)), outer = std::cos(double(light.outer_cone_radians));
    const double f = std::clamp((cosine - outer) / std::max(0.001, inner - outer), 0.0, 1.0);
    return f * f;
}

void draw_curve(ImDrawList& draw, const std::vector<PolarPoint>& curve, ImVec2 center, float radius, ImU32 color) {
    std::vector<ImVec2> points;
    for (const PolarPoint& p : curve) points.push_back({center.x + radius * float(p.x), center.y - radius * float(p.y)});
    draw.AddPolyline(points.data(), int(points.size()), color, ImDrawFlags_None, std::max(1.f, ImGui::GetFontSize() / 9));
}

} // namespace

std::vector<PolarPoint> polar_curve(const IesProfile& profile, const Light& light, double turn_degrees) {
    std::vector<PolarPoint> curve;
    for (int angle = -180; angle <= 180; ++angle) {
        const double sine = std::sin(angle * degree), cosine = std::cos(angle * degree), turn = turn_degrees * degree;
        const double candela = candela_towards(profile, {sine * std::cos(turn), sine * std::sin(turn), -cosine});
        const double length = candela / double(profile.peak) * cone_factor(light, cosine);
        curve.push_back({length * sine, -length * cosine});
    }
    return curve;
}

void draw_polar_plot(const IesProfile& profile, const Light& light) {
    const float side = std::min(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 13), radius = side * 0.46f;
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 center{low.x + ImGui::GetContentRegionAvail().x / 2, low.y + side / 2};
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    for (int ring = 1; ring <= 4; ++ring) draw.AddCircle(center, radius * float(ring) / 4, tone::field, 64);
    for (int angle = 0; angle < 360; angle += 30) {
        const float a = float(angle * degree);
        draw.AddLine(center, {center.x + radius * std::sin(a), center.y + radius * std::cos(a)}, tone::field);
    }
    draw_curve(draw, polar_curve(profile, light, 90), center, radius, tone::axis_y);
    draw_curve(draw, polar_curve(profile, light, 0), center, radius, tone::axis_x);
    ImGui::Dummy({side, side});
}

} // namespace blush
