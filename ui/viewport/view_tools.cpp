#include "ui/viewport/view_tools.h"

#include "core/math.h"
#include "ui/viewport/path_lines.h"
#include "ui/viewport/region_backdrop.h"
#include "ui/viewport/viewport_marks.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <utility>

namespace blush {
namespace {

constexpr int white_radius = 2; // pixels: 5 x 5

const char* hint_of(ViewTool tool) {
    switch (tool) {
    case ViewTool::none: return "";
    case ViewTool::pick_white: return "Click a place that should be white.  Esc: cancel";
    case ViewTool::pick_color: return "Click to pick a colour (scene-linear).  Esc: cancel";
    case ViewTool::meter: return "Click a surface to place a light meter.  Esc: cancel";
    case ViewTool::paths: return "Click a pixel, or drag a rectangle, to see its paths.  Esc: cancel";
    case ViewTool::bleed: return "Click a surface, or drag a rectangle, to see who lights it.  Esc: cancel";
    case ViewTool::region: return "Drag a rectangle to render only this region.  Esc: cancel";
    case ViewTool::measure: return "Drag a rectangle to measure.  Esc: cancel";
    }
    return "";
}

void pick_white(PanelContext& c, double u, double v) {
    const Vec3 white = picked_color(*c.frame, c.denoised.get(), mix_of(c.ui.denoise, c.denoised != nullptr), u, v, white_radius);
    const float y = luminance(white);
    if (!(y > 0) || !is_finite(white)) return c.ui.toasts.note("The image is too dark there to pick a white");
    ViewSettings view = c.project().view;
    view.white = {std::max(white.x / y, 0.f), std::max(white.y / y, 0.f), std::max(white.z / y, 0.f)};
    c.apply(SetView{view});
}

// Sets the colour field that uses the eyedropper, from a single pixel.
void pick_color(PanelContext& c, double u, double v) {
    const Vec3 color = picked_color(*c.frame, c.denoised.get(), mix_of(c.ui.denoise, c.denoised != nullptr), u, v, 0);
    if (!is_finite(color)) return c.ui.toasts.note("The colour of this pixel is not finite");
    c.ui.values.picked = color;
    c.ui.seconds_to_next_frame = 0;
}

void place_meter(PanelContext& c, const Projection& projection, double u, double v) {
    ViewSettings view = c.project().view;
    const auto meter = meter_at(*c.frame, c.scene(), projection, u, v, new_meter_name(view.meters));
    if (!meter) return c.ui.toasts.note("There is no surface at this point");
    view.meters.push_back(*meter);
    c.ui.meters.open = true;
    c.ui.docks.to_front.insert("meters");
    c.apply(SetView{view});
}

void draw_rectangle(ImDrawList& draw, const ImageRect& image, const ImageRegion& r) {
    const ImVec2 low{image.x + r.x * image.width, image.y + r.y * image.height};
    const ImVec2 high{low.x + r.width * image.width, low.y + r.height * image.height};
    draw.AddRect({low.x - 1, low.y - 1}, {high.x + 1, high.y + 1}, IM_COL32(0, 0, 0, 160), 0, 0, 3); // visible on any background
    draw.AddRect(low, high, tone::text);
}

void take_region(PanelContext& c, const ImageRegion& region) {
    const ViewTool tool = std::exchange(c.ui.tool, ViewTool::none);
    c.ui.tool_start.reset();
    if (tool == ViewTool::paths) return trace_paths_of(c, region); // without width and height: of one pixel
    if (region.width <= 0 || region.height <= 0) return;
    if (tool == ViewTool::region) return render_region(c, region);
    ViewSettings v = c.project().view;
    v.measured = region;
    c.ui.docks.to_front.insert("region");
    c.apply(SetView{v});
}

// A drag of a few pixels is a click.
void probe_bleed(PanelContext& c, const Projection& projection, const ImageRect& image, const ImageRegion& region) {
    constexpr float least = 4;
    const ToolStart start = *std::exchange(c.ui.tool_start, std::nullopt);
    c.ui.tool = ViewTool::none;
    BleedView& view = c.ui.bleed;
    if (region.width * image.width >= least && region.height * image.height >= least) {
        view.rect = region;
        view.point.reset();
    } else {
        const auto point = meter_at(*c.frame, c.scene(), projection, start.u, start.v, "");
        if (!point) return c.ui.toasts.note("There is no surface at this point");
        view.point = point;
        view.rect.reset();
    }
    view.chosen = 0;
    view.open = true;
    c.ui.docks.to_front.insert("bleed");
}

} // namespace

Vec3 picked_color(const Frame& frame, const DenoisedImage* denoised, const ImageMix& mix, double u, double v, int radius) {
    const int x = int(u * frame.width), y = int(v * frame.height);
    Vec3 sum{0, 0, 0};
    int count = 0;
    for (int j = std::max(y - radius, 0); j <= std::min(y + radius, frame.height - 1); ++j)
        for (int i = std::max(x - radius, 0); i <= std::min(x + radius, frame.width - 1); ++i, ++count)
            sum = sum + mixed_pixel(frame, denoised, mix, i, j);
    return count > 0 ? sum / float(count) : sum;
}

ImageRegion region_between(double u0, double v0, double u1, double v1) {
    const auto [left, right] = std::minmax({std::clamp(u0, 0.0, 1.0), std::clamp(u1, 0.0, 1.0)});
    const auto [top, bottom] = std::minmax({std::clamp(v0, 0.0, 1.0), std::clamp(v1, 0.0, 1.0)});
    return {float(left), float(top), float(right - left), float(bottom - top)};
}

void draw_measured_region(ImDrawList& draw, const ImageRect& image, const ViewSettings& view) {
    if (view.measured) draw_rectangle(draw, image, *view.measured);
}

void draw_rendered_region(ImDrawList& draw, const ImageRect& image, const ImageRegion& r, bool covers) {
    if (r == ImageRegion{}) return;
    const auto at = [&](float x, float y) { return ImVec2{image.x + x * image.width, image.y + y * image.height}; };
    for (const ImageRegion& part : around(r))
        if (covers) draw.AddRectFilled(at(part.x, part.y), at(part.x + part.width, part.y + part.height), tone::surround);
    const ImVec2 low = at(r.x, r.y), high = at(r.x + r.width, r.y + r.height);
    draw.AddRect({low.x - 1, low.y - 1}, {high.x + 1, high.y + 1}, tone::field_filled);
}

void render_region(PanelContext& c, const ImageRegion& region) {
    RenderSettings r = c.project().render;
    r.region = region;
    c.apply(SetRender{r});
}

bool use_tool(PanelContext& c, const Projection& projection, const ImageRect& image, bool hovered) {
    if (c.ui.tool == ViewTool::none) return false;
    draw_hint(*ImGui::GetWindowDrawList(), hint_of(c.ui.tool));
    if (!c.has_image()) return true;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const double u = image.u(mouse.x), v = image.v(mouse.y);
    if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Left) && image.contains(mouse.x, mouse.y)) {
        switch (c.ui.tool) {
        case ViewTool::none: break;
        case ViewTool::pick_white: pick_white(c, u, v); break;
        case ViewTool::pick_color: pick_color(c, u, v); break;
        case ViewTool::meter: place_meter(c, projection, u, v); break;
        case ViewTool::bleed:
        case ViewTool::measure:
        case ViewTool::paths:
        case ViewTool::region: c.ui.tool_start = ToolStart{u, v}; break;
        }
        if (!c.ui.tool_start) c.ui.tool = ViewTool::none;
    }
    if (!c.ui.tool_start) return true;
    const ImageRegion region = region_between(c.ui.tool_start->u, c.ui.tool_start->v, u, v);
    draw_rectangle(*ImGui::GetWindowDrawList(), image, region);
    if (!ImGui::IsMouseReleased(ImGuiMouseButton_Left)) return true;
    if (c.ui.tool == ViewTool::bleed)
        probe_bleed(c, projection, image, region);
    else
        take_region(c, region);
    return true;
}

} // namespace blush
