#include "ui/viewport/bleed_marks.h"

#include "core/math.h"
#include "measure/metrics/bleed_text.h"
#include "scene/affine.h"
#include "ui/snapshots/aov_pixels.h"
#include "ui/widgets/elided_text.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace blush {
namespace {

constexpr double least_shown = 0.005; // share of the whole
constexpr size_t most_labels = 4;
constexpr int map_alpha = 150;
constexpr float whole_weight = 16; // of a line with all the light

// Towards a sender at infinity, the line is as long as this part of the image's height.
constexpr double part_of_height = 0.5;

void draw_map(ImDrawList& draw, const ImageRect& image, const BleedGrid& grid, int width, int height) {
    const auto across = [&](int x) { return image.x + image.width * float(std::min(x, width)) / float(width); };
    const auto down = [&](int y) { return image.y + image.height * float(std::min(y, height)) / float(height); };
    for (int y = 0; y < grid.rows; ++y)
        for (int x = 0; x < grid.columns; ++x) {
            const BleedCell& cell = grid.cells[size_t(y) * size_t(grid.columns) + size_t(x)];
            if (cell.object == 0) continue;
            draw.AddRectFilled({across(x * grid.cell), down(y * grid.cell)}, {across((x + 1) * grid.cell), down((y + 1) * grid.cell)},
                               hue_of(id_color(cell.object), map_alpha));
        }
}

void draw_ring(ImDrawList& draw, const ScreenPoint& p) {
    const float em = ImGui::GetFontSize();
    draw.AddCircle({p.x, p.y}, em * 0.5f, IM_COL32(0, 0, 0, 200), 0, em * 0.3f);
    draw.AddCircle({p.x, p.y}, em * 0.5f, tone::text, 0, em * 0.14f);
}

void draw_rect(ImDrawList& draw, const ImageRect& image, const ImageRegion& r) {
    const ImVec2 low{image.x + r.x * image.width, image.y + r.y * image.height};
    const ImVec2 high{low.x + r.width * image.width, low.y + r.height * image.height};
    draw.AddRect({low.x - 1, low.y - 1}, {high.x + 1, high.y + 1}, IM_COL32(0, 0, 0, 160), 0, 0, 3);
    draw.AddRect(low, high, tone::text);
}

struct LabelBox {
    ImVec2 low, high;
    bool meets(const LabelBox& o) const { return low.x < o.high.x && o.low.x < high.x && low.y < o.high.y && o.low.y < high.y; }
};

// Beside the end of the line, where it meets no other label; nowhere if there is no such place.
void name_sender(ImDrawList& draw, const ScreenPoint& p, const BleedShare& row, std::vector<LabelBox>& labels) {
    const float em = ImGui::GetFontSize(), gap = em * 0.6f, room = em * 20;
    const std::string text = elided(row.name, max_name_width()) + "  " + percent_text(row.share);
    const ImVec2 size = label_size(text, room), low = draw.GetClipRectMin(), high = draw.GetClipRectMax();
    const ImVec2 corners[] = {{p.x - size.x / 2, p.y - size.y - gap},
                              {p.x - size.x / 2, p.y + gap},
                              {p.x + gap, p.y - size.y / 2},
                              {p.x - gap - size.x, p.y - size.y / 2},
                              {p.x + gap, p.y - 2 * size.y},
                              {p.x - gap - size.x, p.y - 2 * size.y},
                              {p.x + gap, p.y + size.y},
                              {p.x - gap - size.x, p.y + size.y}};
    for (const ImVec2& corner : corners) {
        const ImVec2 at{std::round(std::clamp(corner.x, low.x, std::max(low.x, high.x - size.x))), std::round(corner.y)};
        const LabelBox box{at, {at.x + size.x, at.y + size.y}};
        if (at.y < low.y || box.high.y > high.y || std::ranges::any_of(labels, [&](const LabelBox& o) { return box.meets(o); })) continue;
        labels.push_back(box);
        draw_label(draw, text, at, room, tone::text);
        return;
    }
}

void draw_lines(ImDrawList& draw, const ImageRect& image, const Projection& projection, const BleedReport& report) {
    const double far = part_of_height * projection.height_at(std::abs(dot(report.place - projection.eye(), projection.forward())));
    std::vector<LabelBox> labels;
    for (const BleedShare& row : report.senders) {
        const bool has_end = row.by != SentBy::itself && (row.by == SentBy::light || row.object != 0);
        if (!has_end || !(row.share.value >= least_shown)) continue;
        const Vec3d end = row.infinite ? report.place + row.place * far : row.place;
        const float weight = std::max(1.f, whole_weight * float(row.share.value));
        WorldPen{draw, projection, image, hue_of(to_float(row.rgb), 230), weight, 1 + 1.2f / weight}.line(end, report.place);
        const auto at = projection.project(end);
        if (at && labels.size() < most_labels) name_sender(draw, image.at(*at), row, labels);
    }
}

} // namespace

void draw_bleed(ImDrawList& draw, const ImageRect& image, const Projection& projection, const Scene& scene, const BleedView& view,
                int width, int height) {
    if (!view.open) return;
    if (view.map && view.map_state.output.cell > 0) draw_map(draw, image, view.map_state.output, width, height);
    if (view.rect) draw_rect(draw, image, *view.rect);
    if (view.state.output && view.state.output->has_place && view.state.output->whole.value > 0)
        draw_lines(draw, image, projection, *view.state.output);
    if (!view.point) return;
    if (const auto at = projection.project(placed(scene, *view.point).position)) draw_ring(draw, image.at(*at));
}

} // namespace blush
