#include "ui/light_glyphs.h"

#include "scene/placements.h"
#include "ui/icons.h"
#include "ui/rotation.h"
#include "ui/theme.h"

namespace blush {
namespace {

float glyph_size() { return ImGui::GetFontSize() * 1.25f; }

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

// Draws lines given in the world, cut at the plane of the eye.
struct WorldPen {
    ImDrawList& draw;
    const Projection& projection;
    const ImageRect& image;

    void line(Vec3d a, Vec3d b) const {
        const double near = 1e-3, da = dot(a - projection.eye(), projection.forward()),
                     db = dot(b - projection.eye(), projection.forward());
        if (da < near && db < near) return;
        if (da < near) a = a + (b - a) * ((near - da) / (db - da));
        if (db < near) b = b + (a - b) * ((near - db) / (da - db));
        const auto pa = projection.project(a), pb = projection.project(b);
        if (!pa || !pb) return;
        const ScreenPoint sa = image.at(*pa), sb = image.at(*pb);
        const float width = std::max(1.f, ImGui::GetFontSize() / 12);
        draw.AddLine({sa.x, sa.y}, {sb.x, sb.y}, IM_COL32(0, 0, 0, 110), width * 2.2f);
        draw.AddLine({sa.x, sa.y}, {sb.x, sb.y}, tone::accent, width);
    }
    void circle(const Vec3d& centre, const Vec3d& x, const Vec3d& y) const {
        constexpr int steps = 48;
        for (int i = 0; i < steps; ++i) {
            const double a = 6.28318530718 * i / steps, b = 6.28318530718 * (i + 1) / steps;
            line(centre + x * std::cos(a) + y * std::sin(a), centre + x * std::cos(b) + y * std::sin(b));
        }
    }
};

void draw_rectangle(const WorldPen& pen, const Affined& m, const Light& light) {
    const Vec3d x = m.x * (light.width / 2.0), y = m.y * (light.height / 2.0);
    const Vec3d corners[] = {m.t - x - y, m.t + x - y, m.t + x + y, m.t - x + y};
    for (int i = 0; i < 4; ++i) pen.line(corners[i], corners[(i + 1) % 4]);
}

void draw_cone(const WorldPen& pen, const Vec3d& apex, const Quat& rotation, double half_angle, double length) {
    const double angle = std::min(half_angle, 1.5), radius = length * std::sin(angle);
    const Vec3d centre = apex + rotate(rotation, {0, 0, -1}) * (length * std::cos(angle));
    const Vec3d x = rotate(rotation, {1, 0, 0}) * radius, y = rotate(rotation, {0, 1, 0}) * radius;
    pen.circle(centre, x, y);
    for (const Vec3d& side : {x, -x, y, -y}) pen.line(apex, centre + side);
}

// Lines of the selected light: what shines, how wide.
void draw_extent(const WorldPen& pen, const Scene& scene, Id<Node> id, const Light& light, double distance) {
    const Affined m = world_from_node(scene, id);
    const Quat rotation = world_rotation(scene, id);
    const double reach = pen.projection.height_at(distance) * 0.12;
    switch (light.kind) {
    case Light::Kind::disk: pen.circle(m.t, m.x * double(light.radius), m.y * double(light.radius)); break;
    case Light::Kind::point:
    case Light::Kind::sphere:
        if (light.radius > 0) pen.circle(m.t, pen.projection.right() * double(light.radius), pen.projection.up() * double(light.radius));
        break;
    case Light::Kind::spot:
        draw_cone(pen, m.t, rotation, light.outer_cone_radians, reach * 1.6);
        if (light.inner_cone_radians > 0) draw_cone(pen, m.t, rotation, light.inner_cone_radians, reach * 1.6);
        break;
    case Light::Kind::rectangle: draw_rectangle(pen, m, light); break;
    case Light::Kind::sun: break;
    }
}

bool is_shown(const Scene& scene, Placements& placements, Id<Node> id, const Node& node) {
    return scene.lights.contains(node.light) && placements(id).visible;
}

} // namespace

void draw_light_glyphs(ImDrawList& draw, const Scene& scene, const Projection& projection, const ImageRect& image, Id<Node> selected) {
    Placements placements(scene);
    for (const auto& [id, node] : scene.nodes) {
        if (!is_shown(scene, placements, id, node)) continue;
        const auto point = projection.project(placements(id).world_from_node.t);
        if (!point) continue;
        const Light& light = *scene.lights.find(node.light);
        if (id == selected) draw_extent({draw, projection, image}, scene, id, light, point->distance);
        const ScreenPoint at = image.at(*point);
        if (!image.contains(at.x, at.y)) continue;
        draw.AddCircleFilled({at.x, at.y}, glyph_size() * 0.62f, IM_COL32(20, 20, 20, 150));
        const ImU32 color = id == selected ? tone::accent : light.enabled ? tone::light : tone::dim_text;
        draw_icon(draw, icon_of(light.kind), {at.x, at.y}, glyph_size() * 0.8f, color);
    }
}

Id<Node> light_under(const Scene& scene, const Projection& projection, const ImageRect& image, ScreenPoint mouse) {
    Id<Node> found;
    double nearest = 1e300;
    Placements placements(scene);
    for (const auto& [id, node] : scene.nodes) {
        if (!is_shown(scene, placements, id, node)) continue;
        const auto point = projection.project(placements(id).world_from_node.t);
        if (!point || point->distance >= nearest) continue;
        const ScreenPoint at = image.at(*point);
        if (std::hypot(at.x - mouse.x, at.y - mouse.y) > glyph_size() * 0.62f) continue;
        nearest = point->distance;
        found = id;
    }
    return found;
}

} // namespace blush
