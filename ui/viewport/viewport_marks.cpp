#include "ui/viewport/viewport_marks.h"

#include "core/math.h"
#include "ui/widgets/elided_text.h"
#include "ui/window/theme.h"

#include <cmath>
#include <numbers>

namespace blush {

std::optional<std::pair<ScreenPoint, ScreenPoint>> projected_line(const Projection& projection, const ImageRect& image, Vec3d a, Vec3d b) {
    const double near = 1e-3, da = dot(a - projection.eye(), projection.forward()), db = dot(b - projection.eye(), projection.forward());
    if (da < near && db < near) return {};
    if (da < near) a = a + (b - a) * ((near - da) / (db - da));
    if (db < near) b = b + (a - b) * ((near - db) / (da - db));
    const auto pa = projection.project(a), pb = projection.project(b);
    if (!pa || !pb) return {};
    return std::pair{image.at(*pa), image.at(*pb)};
}

void WorldPen::line(Vec3d a, Vec3d b) const {
    const auto ends = projected_line(projection, image, a, b);
    if (!ends) return;
    const auto& [sa, sb] = *ends;
    const float width = std::max(1.f, ImGui::GetFontSize() / 12) * weight;
    const ImU32 shade = IM_COL32(0, 0, 0, 110 * (color >> IM_COL32_A_SHIFT) / 255);
    draw.AddLine({sa.x, sa.y}, {sb.x, sb.y}, shade, width * edge);
    draw.AddLine({sa.x, sa.y}, {sb.x, sb.y}, color, width);
}

void WorldPen::circle(const Vec3d& centre, const Vec3d& x, const Vec3d& y) const {
    constexpr int steps = 48;
    for (int i = 0; i < steps; ++i) {
        const double a = 2 * std::numbers::pi * i / steps, b = 2 * std::numbers::pi * (i + 1) / steps;
        line(centre + x * std::cos(a) + y * std::sin(a), centre + x * std::cos(b) + y * std::sin(b));
    }
}

void WorldPen::cross(const Vec3d& centre, double half) const {
    const Vec3d a = (projection.right() + projection.up()) * half, b = (projection.right() - projection.up()) * half;
    line(centre - a, centre + a);
    line(centre - b, centre + b);
}

void draw_read_pixel(ImDrawList& draw, const ImageRect& image, double u, double v) {
    const ImVec2 at{image.x + float(u) * image.width, image.y + float(v) * image.height};
    const float radius = ImGui::GetFontSize() * 0.4f;
    draw.AddCircle(at, radius, IM_COL32(0, 0, 0, 160), 0, 3);
    draw.AddCircle(at, radius, tone::text);
}

float max_name_width() { return ImGui::GetFontSize() * 14; }

ImVec2 label_size(const std::string& text, float room) {
    const float em = ImGui::GetFontSize();
    const ImVec2 size = ImGui::CalcTextSize(elided_middle(text, room - em).c_str());
    return {size.x + em, size.y + em * 0.5f};
}

ImVec2 draw_label(ImDrawList& draw, const std::string& text, const ImVec2& at, float room, ImU32 color) {
    const float em = ImGui::GetFontSize();
    const ImVec2 size = label_size(text, room);
    draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(20, 20, 20, 200), em * 0.25f);
    draw.AddText({at.x + em * 0.5f, at.y + em * 0.25f}, color, elided_middle(text, room - em).c_str());
    return size;
}

void draw_hint(ImDrawList& draw, const std::string& text) {
    const ImVec2 low = draw.GetClipRectMin(), high = draw.GetClipRectMax();
    const float em = ImGui::GetFontSize(), wrap = std::max(high.x - low.x - 3 * em, em);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    // Below the list of AOVs, if it would reach there.
    const bool reaches_aovs = size.x > high.x - low.x - 26 * em;
    const ImVec2 at{std::round((low.x + high.x - size.x) / 2), std::round(low.y + em * (reaches_aovs ? 2.6f : 1.f))};
    draw.AddRectFilled({at.x - em * 0.6f, at.y - em * 0.3f}, {at.x + size.x + em * 0.6f, at.y + size.y + em * 0.3f},
                       IM_COL32(20, 20, 20, 220), em * 0.25f);
    draw.AddText(ImGui::GetFont(), em, at, tone::text, text.c_str(), nullptr, wrap);
}

} // namespace blush
