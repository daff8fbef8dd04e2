#include "ui/gl/icons.h"

#include "ui/window/theme.h"

#include <cmath>
#include <numbers>

namespace blush {
namespace {

// A pen in the icon's own coordinates: -1 .. 1, y down.
struct Pen {
    ImDrawList& draw;
    ImVec2 centre;
    float half;
    ImU32 color;
    float width;

    ImVec2 at(float x, float y) const { return {centre.x + x * half, centre.y + y * half}; }
    void line(float x0, float y0, float x1, float y1) const { draw.AddLine(at(x0, y0), at(x1, y1), color, width); }
    void circle(float x, float y, float r) const { draw.AddCircle(at(x, y), r * half, color, 0, width); }
    void dot(float x, float y, float r) const { draw.AddCircleFilled(at(x, y), r * half, color); }
    void box(float x0, float y0, float x1, float y1) const { draw.AddRect(at(x0, y0), at(x1, y1), color, 0.15f * half, 0, width); }
    void rays(float inner, float outer) const {
        for (int i = 0; i < 8; ++i) {
            const float angle = float(i) * std::numbers::pi_v<float> / 4, c = std::cos(angle), s = std::sin(angle);
            line(c * inner, s * inner, c * outer, s * outer);
        }
    }
};

void draw_mesh(const Pen& p) {
    p.line(0, -0.9f, 0.8f, -0.45f), p.line(0.8f, -0.45f, 0.8f, 0.45f), p.line(0.8f, 0.45f, 0, 0.9f);
    p.line(0, 0.9f, -0.8f, 0.45f), p.line(-0.8f, 0.45f, -0.8f, -0.45f), p.line(-0.8f, -0.45f, 0, -0.9f);
    p.line(-0.8f, -0.45f, 0, 0), p.line(0.8f, -0.45f, 0, 0), p.line(0, 0, 0, 0.9f);
}

void draw_camera(const Pen& p) {
    p.box(-0.9f, -0.5f, 0.35f, 0.55f);
    p.line(0.35f, 0, 0.9f, -0.45f), p.line(0.9f, -0.45f, 0.9f, 0.5f), p.line(0.9f, 0.5f, 0.35f, 0.05f);
}

void draw_eye(const Pen& p) {
    p.draw.AddBezierQuadratic(p.at(-0.95f, 0), p.at(0, -1.15f), p.at(0.95f, 0), p.color, p.width);
    p.draw.AddBezierQuadratic(p.at(-0.95f, 0), p.at(0, 1.15f), p.at(0.95f, 0), p.color, p.width);
    p.dot(0, 0, 0.32f);
}

void draw_spot(const Pen& p) {
    p.line(-0.3f, -0.85f, 0.3f, -0.85f), p.line(-0.3f, -0.85f, -0.45f, -0.2f), p.line(0.3f, -0.85f, 0.45f, -0.2f),
        p.line(-0.45f, -0.2f, 0.45f, -0.2f);
    p.line(-0.5f, 0.15f, -0.85f, 0.85f), p.line(0, 0.15f, 0, 0.85f), p.line(0.5f, 0.15f, 0.85f, 0.85f);
}

void draw_folder(const Pen& p) {
    p.line(-0.9f, -0.6f, -0.25f, -0.6f), p.line(-0.25f, -0.6f, 0, -0.35f), p.line(0, -0.35f, 0.9f, -0.35f);
    p.line(0.9f, -0.35f, 0.9f, 0.65f), p.line(0.9f, 0.65f, -0.9f, 0.65f), p.line(-0.9f, 0.65f, -0.9f, -0.6f);
}

void draw_file(const Pen& p) {
    p.line(-0.6f, -0.85f, 0.2f, -0.85f), p.line(0.2f, -0.85f, 0.6f, -0.45f), p.line(0.6f, -0.45f, 0.6f, 0.85f);
    p.line(0.6f, 0.85f, -0.6f, 0.85f), p.line(-0.6f, 0.85f, -0.6f, -0.85f);
}

void draw_move(const Pen& p) {
    for (const float s : {-1.f, 1.f}) {
        p.line(0, 0, 0, 0.9f * s), p.line(0, 0.9f * s, -0.28f, 0.6f * s), p.line(0, 0.9f * s, 0.28f, 0.6f * s);
        p.line(0, 0, 0.9f * s, 0), p.line(0.9f * s, 0, 0.6f * s, -0.28f), p.line(0.9f * s, 0, 0.6f * s, 0.28f);
    }
}

void draw_rotate(const Pen& p) {
    p.draw.PathArcTo(p.centre, 0.75f * p.half, -0.6f, 4.4f);
    p.draw.PathStroke(p.color, 0, p.width);
    p.line(0.62f, -0.42f, 0.98f, -0.3f), p.line(0.62f, -0.42f, 0.58f, -0.85f);
}

void draw_scale(const Pen& p) {
    p.box(-0.85f, 0, 0, 0.85f);
    p.line(-0.1f, 0.1f, 0.85f, -0.85f), p.line(0.85f, -0.85f, 0.35f, -0.85f), p.line(0.85f, -0.85f, 0.85f, -0.35f);
}

void draw_globe(const Pen& p) {
    p.circle(0, 0, 0.85f), p.line(-0.85f, 0, 0.85f, 0);
    p.draw.AddBezierQuadratic(p.at(0, -0.85f), p.at(0.85f, 0), p.at(0, 0.85f), p.color, p.width);
    p.draw.AddBezierQuadratic(p.at(0, -0.85f), p.at(-0.85f, 0), p.at(0, 0.85f), p.color, p.width);
}

// Tilted axes on a small box.
void draw_local_axes(const Pen& p) {
    p.box(-0.3f, -0.3f, 0.3f, 0.3f);
    p.line(0.3f, -0.3f, 0.85f, -0.85f), p.line(-0.3f, -0.3f, -0.85f, -0.85f), p.line(0, 0.3f, 0, 0.95f);
}

} // namespace

Icon icon_of(Light::Kind kind) {
    switch (kind) {
    case Light::Kind::point: return Icon::point;
    case Light::Kind::spot: return Icon::spot;
    case Light::Kind::sun: return Icon::sun;
    case Light::Kind::rectangle: return Icon::rectangle;
    case Light::Kind::disk: return Icon::disk;
    case Light::Kind::sphere: return Icon::sphere;
    }
    return Icon::point;
}

void draw_icon(ImDrawList& draw, Icon icon, ImVec2 centre, float size, ImU32 color) {
    const Pen p{draw, centre, size / 2, color, std::fmax(1.f, size / 13)};
    switch (icon) {
    case Icon::point: p.circle(0, 0, 0.38f), p.rays(0.62f, 0.9f); break;
    case Icon::spot: draw_spot(p); break;
    case Icon::sun: p.dot(0, 0, 0.4f), p.rays(0.6f, 0.95f); break;
    case Icon::rectangle:
        p.box(-0.85f, -0.6f, 0.85f, 0.1f), p.line(-0.5f, 0.35f, -0.6f, 0.8f), p.line(0, 0.35f, 0, 0.8f), p.line(0.5f, 0.35f, 0.6f, 0.8f);
        break;
    case Icon::disk:
        p.circle(0, -0.25f, 0.6f), p.line(-0.5f, 0.5f, -0.6f, 0.9f), p.line(0, 0.55f, 0, 0.95f), p.line(0.5f, 0.5f, 0.6f, 0.9f);
        break;
    case Icon::sphere: p.circle(0, 0, 0.6f), p.dot(-0.2f, -0.2f, 0.14f); break;
    case Icon::mesh: draw_mesh(p); break;
    case Icon::group: p.line(-0.8f, 0, 0.8f, 0), p.line(0, -0.8f, 0, 0.8f), p.circle(0, 0, 0.3f); break;
    case Icon::camera: draw_camera(p); break;
    case Icon::folder: draw_folder(p); break;
    case Icon::file: draw_file(p); break;
    case Icon::eye: draw_eye(p); break;
    case Icon::eye_closed: p.draw.AddBezierQuadratic(p.at(-0.95f, -0.1f), p.at(0, 1.f), p.at(0.95f, -0.1f), color, p.width); break;
    case Icon::play: draw.AddTriangleFilled(p.at(-0.5f, -0.7f), p.at(-0.5f, 0.7f), p.at(0.7f, 0), color); break;
    case Icon::pause:
        draw.AddRectFilled(p.at(-0.6f, -0.65f), p.at(-0.15f, 0.65f), color);
        draw.AddRectFilled(p.at(0.15f, -0.65f), p.at(0.6f, 0.65f), color);
        break;
    case Icon::move: draw_move(p); break;
    case Icon::rotate: draw_rotate(p); break;
    case Icon::scale: draw_scale(p); break;
    case Icon::world_axes: draw_globe(p); break;
    case Icon::local_axes: draw_local_axes(p); break;
    case Icon::arrow_up: p.line(0, 0.8f, 0, -0.8f), p.line(0, -0.8f, -0.55f, -0.2f), p.line(0, -0.8f, 0.55f, -0.2f); break;
    }
}

void icon_item(Icon icon, ImU32 color, float height) {
    const float size = ImGui::GetFontSize();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy({size, height});
    draw_icon(*ImGui::GetWindowDrawList(), icon, {at.x + size / 2, at.y + height / 2}, size * 0.86f, color);
}

bool icon_button(const char* id, Icon icon, ImU32 color) {
    const float size = ImGui::GetFrameHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::InvisibleButton(id, {size, size});
    if (ImGui::IsItemHovered()) {
        ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size, at.y + size}, tone::field_hovered, 3);
        color = tone::text;
    }
    draw_icon(*ImGui::GetWindowDrawList(), icon, {at.x + size / 2, at.y + size / 2}, ImGui::GetFontSize() * 0.86f, color);
    return pressed;
}

} // namespace blush
