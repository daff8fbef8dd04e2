#include "ui/viewport/path_lines.h"

#include "core/math.h"
#include "ui/viewport/viewport_marks.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

constexpr ImU32 blocked_color = IM_COL32(240, 72, 62, 255), shade = IM_COL32(0, 0, 0, 130);

ImU32 with_alpha(ImU32 color, int alpha) { return (color & ~IM_COL32_A_MASK) | (ImU32(alpha) << IM_COL32_A_SHIFT); }

struct ScreenLine {
    ImVec2 a, b;
};

// The part within the rectangle (Liang and Barsky 1984): dashes of a line that leaves the screen would have no end.
bool clip(ScreenLine& line, const ImVec2& low, const ImVec2& high) {
    float from = 0, to = 1;
    const ImVec2 d{line.b.x - line.a.x, line.b.y - line.a.y};
    const auto side = [&](float p, float q) {
        if (p == 0) return q >= 0;
        const float t = q / p;
        p < 0 ? from = std::max(from, t) : to = std::min(to, t);
        return from <= to;
    };
    if (!side(-d.x, line.a.x - low.x) || !side(d.x, high.x - line.a.x) || !side(-d.y, line.a.y - low.y) || !side(d.y, high.y - line.a.y))
        return false;
    const ImVec2 a = line.a;
    line = {{a.x + from * d.x, a.y + from * d.y}, {a.x + to * d.x, a.y + to * d.y}};
    return true;
}

struct PathPen {
    ImDrawList& draw;
    const ImageRect& image;
    const Projection& projection;
    float em;
    bool prominent; // the shown path
    int alpha;

    std::optional<ScreenLine> seen(const Vec3d& a, const Vec3d& b) const {
        const auto ends = projected_line(projection, image, a, b);
        if (!ends) return {};
        ScreenLine line{{ends->first.x, ends->first.y}, {ends->second.x, ends->second.y}};
        return clip(line, draw.GetClipRectMin(), draw.GetClipRectMax()) ? std::optional(line) : std::nullopt;
    }
    void line(const Vec3d& a, const Vec3d& b, ImU32 color, float width) const {
        const auto l = seen(a, b);
        if (!l) return;
        if (prominent) draw.AddLine(l->a, l->b, shade, width + 2);
        draw.AddLine(l->a, l->b, color, width);
    }
    // `phase`: 0 .. 1 of a dash. Those of different paths differ, or the dashes of rays from one point would look like rings.
    void dashes(const Vec3d& a, const Vec3d& b, ImU32 color, float width, float phase) const {
        const auto l = seen(a, b);
        if (!l) return;
        const ImVec2 d{l->b.x - l->a.x, l->b.y - l->a.y};
        const float length = std::hypot(d.x, d.y), period = em * (prominent ? 0.7f : 4.f);
        for (float t = -phase * period; t < length; t += period) {
            const float from = std::max(t, 0.f) / length, to = std::clamp(t + period / 2, 0.f, length) / length;
            if (from >= to) continue;
            draw.AddLine({l->a.x + d.x * from, l->a.y + d.y * from}, {l->a.x + d.x * to, l->a.y + d.y * to}, color, width);
        }
    }
    std::optional<ImVec2> at(const Vec3d& p) const {
        const auto point = projection.project(p);
        if (!point) return {};
        const ScreenPoint s = image.at(*point);
        return ImVec2{s.x, s.y};
    }
    void cross(const Vec3d& p, ImU32 color) const {
        const auto c = at(p);
        if (!c) return;
        const float r = em * (prominent ? 0.35f : 0.2f), width = prominent ? 2.f : 1.f;
        draw.AddLine({c->x - r, c->y - r}, {c->x + r, c->y + r}, color, width);
        draw.AddLine({c->x - r, c->y + r}, {c->x + r, c->y - r}, color, width);
    }
    void diamond(const Vec3d& p, ImU32 color) const {
        const auto c = at(p);
        if (!c) return;
        const float r = em * (prominent ? 0.35f : 0.2f);
        draw.AddQuad({c->x - r, c->y}, {c->x, c->y - r}, {c->x + r, c->y}, {c->x, c->y + r}, color, prominent ? 2.f : 1.f);
    }
    void label(const Vec3d& p, const std::string& text) const {
        const auto c = at(p);
        if (!c) return;
        const ImVec2 size = label_size(text, em * 12), high = draw.GetClipRectMax();
        draw_label(draw, text, {std::min(c->x + em * 0.6f, high.x - size.x), std::min(c->y + em * 0.2f, high.y - size.y)}, em * 12,
                   tone::text);
    }
};

void draw_next_event(const PathPen& pen, const PathVertex& v, float phase) {
    const NextEvent& e = *v.next_event;
    const ImU32 color = with_alpha(e.blocked ? blocked_color : hue_of(e.arrived), pen.alpha);
    pen.dashes(e.from, e.to, color, pen.prominent ? 1.5f : 1.f, phase);
    if (pen.prominent && e.blocked && !e.blocker.empty()) pen.cross(e.to, color);
}

// The first `count` vertices of a path.
void draw_path(const PathPen& pen, const RecordedPath& path, size_t count, float width) {
    const int alpha = pen.alpha;
    const float turns = float(path.sample) * 0.618034f, phase = pen.prominent ? 0 : turns - std::floor(turns);
    Vec3d from = path.eye;
    for (size_t k = 0; k < count; ++k) {
        const PathVertex& v = path.vertices[k];
        const ImU32 color = with_alpha(hue_of(v.arriving), alpha);
        pen.line(from, v.position, color, width);
        from = v.position;
        if (v.next_event) draw_next_event(pen, v, phase);
        if (std::isinf(v.pdf)) pen.diamond(v.position, color);
        if (v.end == PathEnd::roulette) pen.cross(v.position, with_alpha(tone::text, alpha));
        if (!pen.prominent) continue;
        if (const auto dot = pen.at(v.position); dot && v.end != PathEnd::roulette && v.met != Met::background)
            pen.draw.AddCircleFilled(*dot, pen.em * 0.2f, color);
        if (v.end == PathEnd::roulette) pen.label(v.position, fmt::format("roulette, q = {:.2g}", v.survival));
    }
}

// Pixels; by the contribution of the path relative to the brightest one.
float width_of(const RecordedPath& path, float brightest, float em) {
    const float light = luminance(path.radiance);
    return em / 14 * (brightest > 0 && light > 0 ? 1 + 2.5f * std::sqrt(std::min(light / brightest, 1.f)) : 1);
}

// The scene and its settings as the image shows them.
PathWork::Input present_input(const PanelContext& c) {
    PathWork::Input input{c.scene(), c.project().render, {}, c.ui.paths.samples};
    input.settings.width = std::max(c.render_width, 1);
    input.settings.height = std::max(c.render_height, 1);
    return input;
}

} // namespace

void follow_paths(PanelContext& c) {
    PathsView& view = c.ui.paths;
    const bool armed = c.ui.tool == ViewTool::paths;
    if (!view.open) {
        if (armed) c.ui.tool = ViewTool::none;
        view.runner.reset();
        view.request.reset();
        view.state = {};
        view.playing = false;
        return;
    }
    if (!view.runner && (armed || view.request)) view.runner = std::make_shared<PathRunner>();
    if (!view.runner) return;
    if (armed)
        view.runner->measure(present_input(c)); // so that the scene is compiled before the click
    else if (view.request) {
        view.request->samples = view.samples;
        view.runner->measure(*view.request);
    }
    PathRunner::State now = view.runner->state();
    // The panel may have been drawn before the image.
    if (now.output != view.state.output) c.ui.seconds_to_next_frame = 0;
    view.state = std::move(now);
    if (!view.state.rests && view.state.failure.empty()) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, 0.01);
    if (view.playing) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, play(view, ImGui::GetTime()));
}

void trace_paths_of(PanelContext& c, const ImageRegion& region) {
    PathsView& view = c.ui.paths;
    view.open = true;
    view.request = present_input(c);
    view.request->pixels = traced_pixels(region, view.request->settings.width, view.request->settings.height);
    view.region = region;
    view.view = c.scene().view;
    view.path = view.steps = 0;
    c.ui.docks.to_front.insert("paths");
    follow_paths(c);
}

void draw_path_lines(ImDrawList& draw, const ImageRect& image, const Projection& projection, const PathsView& view) {
    const PathSet* set = view.set();
    const RecordedPath* shown = view.shown();
    if (!view.open || !shown) return;
    const float em = ImGui::GetFontSize();
    float brightest = 0;
    for (const auto& path : set->paths) brightest = std::max(brightest, luminance(path->radiance));
    const size_t others = view.others ? std::min(set->paths.size(), most_drawn_paths) : 0;
    // Many paths together are about as opaque as a few.
    const int alpha = std::clamp(int(4000 / std::max<size_t>(others, 1)), 30, 120);
    // Without a graphics card, smooth edges of many lines take as long as the rest of the frame.
    const ImDrawListFlags flags = draw.Flags;
    draw.Flags &= ~ImDrawListFlags_AntiAliasedLines;
    const PathPen thin{draw, image, projection, em, false, alpha};
    for (size_t k = 0; k < others; ++k)
        if (const RecordedPath& path = *set->paths[k]; &path != shown)
            draw_path(thin, path, path.vertices.size(), 0.6f * width_of(path, brightest, em));
    draw.Flags = flags;
    const PathPen pen{draw, image, projection, em, true, 255};
    draw_path(pen, *shown, view.shown_vertices(), 1 + width_of(*shown, brightest, em));
}

} // namespace blush
