#include "ui/lights/light_glyphs.h"

#include "scene/lights/light_units.h"
#include "scene/lights/light_visibility.h"
#include "scene/world_transforms.h"
#include "ui/gl/icons.h"
#include "ui/lights/light_outline.h"
#include "ui/viewport/viewport_marks.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

float glyph_size() { return ImGui::GetFontSize() * 1.25f; }

ImU32 color_of(const Light& light, int alpha) {
    Light unit = light;
    unit.intensity = 1;
    return hue_of(light_emission(unit), alpha);
}

void draw_icon_of(ImDrawList& draw, ScreenPoint at, const Light& light, bool shining, bool selected) {
    const float size = glyph_size();
    draw.AddCircleFilled({at.x, at.y}, size * 0.62f, IM_COL32(20, 20, 20, 170));
    if (selected) draw.AddCircle({at.x, at.y}, size * 0.68f, tone::accent, 0, std::max(1.5f, size / 12));
    draw_icon(draw, icon_of(light.kind), {at.x, at.y}, size * 0.8f, shining ? color_of(light, 255) : tone::dim_text);
    if (!light.enabled) // muted: struck through
        draw.AddLine({at.x - size * 0.4f, at.y + size * 0.4f}, {at.x + size * 0.4f, at.y - size * 0.4f}, tone::failure,
                     std::max(1.5f, size / 12));
}

// Calls see(id, light, where, distance) for each visible light in front of the viewer.
template <class See>
void for_each_light(const Scene& scene, const Projection& projection, const ImageRect& image, const UiState& ui, const See& see) {
    WorldTransforms placements(scene);
    for (const auto& [id, node] : scene.nodes) {
        const Light* light = scene.lights.find(node.light);
        if (!light || !placements(id).visible || (ui.light_camera && ui.light_camera->node == id)) continue;
        const auto point = projection.project(placements(id).world_from_node.t);
        if (point) see(id, *light, image.at(*point), point->distance);
    }
}

} // namespace

void draw_light_glyphs(ImDrawList& draw, const Scene& scene, const Projection& projection, const ImageRect& image, const UiState& ui) {
    const bool some_solo = any_solo(scene);
    for_each_light(scene, projection, image, ui, [&](Id<Node> id, const Light& light, ScreenPoint at, double distance) {
        const bool selected = ui.is_selected(id), shining = emits_light(light, some_solo);
        const WorldPen pen{draw, projection, image, selected ? tone::accent : color_of(light, shining ? 150 : 70)};
        for (const WorldLine& line : light_outline(scene, id, light, projection, outline_reach(projection, distance)))
            pen.line(line.from, line.to);
        if (image.contains(at.x, at.y)) draw_icon_of(draw, at, light, shining, selected);
    });
}

Id<Node> light_under(const Scene& scene, const Projection& projection, const ImageRect& image, const UiState& ui, ScreenPoint mouse) {
    Id<Node> found;
    double nearest = 1e300;
    for_each_light(scene, projection, image, ui, [&](Id<Node> id, const Light&, ScreenPoint at, double distance) {
        if (distance >= nearest || std::hypot(at.x - mouse.x, at.y - mouse.y) > glyph_size() * 0.62f) return;
        nearest = distance;
        found = id;
    });
    return found;
}

} // namespace blush
