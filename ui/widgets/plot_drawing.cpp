#include "ui/widgets/plot_drawing.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace blush {
namespace {

struct Pen {
    ImDrawList& draw;
    ImVec2 origin;
    const ImFont& font;
    float size;

    ImVec2 at(double x, double y) const { return {origin.x + float(x), origin.y + float(y)}; }
    ImVec2 at(const PlotPixel& p) const { return at(p.x, p.y); }

    // `anchor`: 0 left-aligned at x, 0.5 centred, 1 right-aligned. `y` is the baseline.
    void text(double x, double y, double anchor, const std::string& text, ImU32 color) const {
        if (text.empty()) return;
        const float width = font.CalcTextSizeA(size, FLT_MAX, 0, text.c_str()).x, ascent = font.Ascent * size / font.FontSize;
        const ImVec2 where{std::round(origin.x + float(x - anchor * double(width))), std::round(origin.y + float(y) - ascent)};
        draw.AddText(&font, size, where, color, text.c_str());
    }
    void line(ImVec2 a, ImVec2 b, ImU32 color, float width = 1) const { draw.AddLine(a, b, color, width); }

    // The dash pattern continues around corners.
    void dashed(const std::vector<PlotPixel>& line, ImU32 color, float width, float on, float off) const {
        float left = on;
        bool visible = true;
        for (size_t i = 0; i + 1 < line.size(); ++i) {
            const ImVec2 a = at(line[i]), b = at(line[i + 1]);
            const float length = std::hypot(b.x - a.x, b.y - a.y);
            for (float done = 0; done < length;) {
                const float step = std::min(left, length - done);
                const auto along = [&](float d) { return ImVec2{a.x + (b.x - a.x) * d / length, a.y + (b.y - a.y) * d / length}; };
                if (visible) draw.AddLine(along(done), along(done + step), color, width);
                done += step;
                left -= step;
                if (left > 0) continue;
                visible = !visible;
                left = visible ? on : off;
            }
        }
    }
    void stroke(const std::vector<PlotPixel>& line, PlotCurve::Line style, ImU32 color, float width) const {
        switch (style) {
        case PlotCurve::Line::solid: {
            std::vector<ImVec2> points;
            for (const PlotPixel& p : line) points.push_back(at(p));
            return draw.AddPolyline(points.data(), int(points.size()), color, ImDrawFlags_None, width);
        }
        case PlotCurve::Line::dashed: return dashed(line, color, width, 0.4f * size, 0.3f * size);
        case PlotCurve::Line::dotted: return dashed(line, color, width, 0.12f * size, 0.25f * size);
        }
    }
};

void draw_grid(const Pen& pen, const PlotLayout& l, const PlotTones& tones) {
    for (const bool major : {false, true}) {
        for (const PlotTick& t : l.x_ticks)
            if (t.major == major)
                pen.line(pen.at(std::round(t.at), l.top), pen.at(std::round(t.at), l.bottom), major ? tones.major : tones.minor);
        for (const PlotTick& t : l.y_ticks)
            if (t.major == major)
                pen.line(pen.at(l.left, std::round(t.at)), pen.at(l.right, std::round(t.at)), major ? tones.major : tones.minor);
    }
    for (const PlotTick& t : l.x_ticks) pen.text(t.at, l.bottom + 1.35 * double(pen.size), 0.5, t.text, tones.dim_text);
    for (const PlotTick& t : l.y_ticks)
        pen.text(l.left - 0.5 * double(pen.size), t.at + 0.35 * double(pen.size), 1, t.text, tones.dim_text);
    pen.draw.AddRect(pen.at(l.left, l.top), pen.at(l.right, l.bottom), tones.box);
}

// Fills the band between two curves as one mesh: antialiased pieces would have visible seams.
void draw_band(const Pen& pen, const std::vector<PlotPixel>& band, ImU32 color) {
    const ImDrawListFlags flags = std::exchange(pen.draw.Flags, pen.draw.Flags & ~ImDrawListFlags_AntiAliasedFill);
    for (size_t i = 0, last = band.size() - 1; 2 * i + 2 < band.size(); ++i)
        pen.draw.AddQuadFilled(pen.at(band[i]), pen.at(band[i + 1]), pen.at(band[last - i - 1]), pen.at(band[last - i]), color);
    pen.draw.Flags = flags;
}

void draw_curve(const Pen& pen, const PlotCurve& curve, const PlotLayout::Curve& c, const PlotTones& tones) {
    const ImU32 color = parse_color(curve.color);
    const bool guide = curve.dots == PlotCurve::Dots::none;
    if (!c.band.empty()) draw_band(pen, c.band, parse_color(curve.color, 0.16f));
    pen.stroke(c.line, curve.line, color, (guide ? 0.08f : 0.12f) * pen.size);
    for (const PlotPixel& p : c.dots) {
        pen.draw.AddCircleFilled(pen.at(p), 0.19f * pen.size, color);
        if (curve.dots == PlotCurve::Dots::hollow) pen.draw.AddCircleFilled(pen.at(p), 0.11f * pen.size, tones.ground);
    }
}

void draw_lines(const Pen& pen, const PlotLayout& l, const PlotTones& tones) {
    for (const PlotLayout::Mark& m : l.marks) {
        pen.dashed({{m.at, l.top}, {m.at, l.bottom}}, parse_color(m.color, 0.75f), 1, 0.15f * pen.size, 0.25f * pen.size);
        pen.text(m.text.x, m.text.y, 0, m.label, parse_color(m.color));
    }
    for (const PlotLayout::Level& level : l.levels) {
        pen.dashed({{l.left, level.at}, {l.right, level.at}}, tones.dim_text, 1, 0.5f * pen.size, 0.35f * pen.size);
        pen.text(level.text.x, level.text.y, 1, level.label, tones.text);
    }
}

void draw_legend(const Pen& pen, const Plot& plot, const PlotLayout& l, const PlotTones& tones) {
    if (l.legend.empty()) return;
    const double em = double(pen.size), left = l.legend.front().text.x - 1.25 * l.legend_sample;
    double right = left;
    for (const PlotLayout::Entry& e : l.legend)
        right = std::max(right, e.text.x + double(pen.font.CalcTextSizeA(pen.size, FLT_MAX, 0, plot.curves[e.curve].name.c_str()).x));
    // Grid lines are interrupted behind labels.
    pen.draw.AddRectFilled(pen.at(left - 0.4 * em, l.legend.front().text.y - 1.15 * em),
                           pen.at(right + 0.4 * em, l.legend.back().text.y + 0.45 * em),
                           (tones.ground & ~IM_COL32_A_MASK) | IM_COL32(0, 0, 0, 210), 0.2f * pen.size);
    for (const PlotLayout::Entry& e : l.legend) {
        const PlotCurve& c = plot.curves[e.curve];
        const double y = e.text.y - 0.33 * em;
        pen.stroke({{e.text.x - 1.25 * l.legend_sample, y}, {e.text.x - 0.25 * l.legend_sample, y}}, c.line, parse_color(c.color),
                   0.14f * pen.size);
        pen.text(e.text.x, e.text.y, 0, c.name, tones.text);
    }
}

} // namespace

PlotTones plot_tones_dark() {
    const auto grey = [](int v) { return IM_COL32(v, v, v, 255); };
    return {grey(30), grey(205), grey(145), grey(78), grey(58), grey(41)};
}

PlotTones plot_tones_paper() {
    const auto grey = [](int v) { return IM_COL32(v, v, v, 255); };
    return {grey(255), grey(40), grey(85), grey(150), grey(212), grey(238)};
}

PlotMetrics plot_metrics(ImVec2 size, const ImFont& font, float font_size, bool legend) {
    const auto width = [&font, font_size](std::string_view text) {
        return double(font.CalcTextSizeA(font_size, FLT_MAX, 0, text.data(), text.data() + text.size()).x);
    };
    return {double(size.x), double(size.y), double(font_size), legend, width};
}

void draw_plot(ImDrawList& draw, const Plot& plot, const PlotLayout& l, ImVec2 origin, const ImFont& font, float font_size,
               const PlotTones& tones) {
    const Pen pen{draw, origin, font, font_size};
    const double em = double(font_size);
    draw.AddRectFilled(pen.at(l.left, l.top), pen.at(l.right, l.bottom), tones.ground);
    draw_grid(pen, l, tones);
    draw.PushClipRect(pen.at(l.left, l.top), pen.at(l.right, l.bottom), true);
    // References are drawn below the curves that are compared with them.
    for (const bool guides : {true, false})
        for (const PlotLayout::Curve& c : l.curves)
            if (guides == (plot.curves[c.index].dots == PlotCurve::Dots::none)) draw_curve(pen, plot.curves[c.index], c, tones);
    draw_lines(pen, l, tones);
    draw_legend(pen, plot, l, tones);
    draw.PopClipRect();
    pen.text(l.left, l.top - 0.7 * em, 0, plot.title, tones.text);
    pen.text((l.left + l.right) / 2, l.bottom + 3.2 * em, 0.5, plot.x_label, tones.dim_text);
}

void draw_line_sample(ImDrawList& draw, PlotCurve::Line line, ImVec2 at, float length, ImU32 color, float font_size) {
    const Pen pen{draw, at, *ImGui::GetFont(), font_size};
    pen.stroke({{0, 0}, {double(length), 0}}, line, color, 0.14f * font_size);
}

ImU32 parse_color(const std::string& text, float alpha) {
    unsigned rgb = 0;
    if (text.size() != 7 || text[0] != '#' || std::from_chars(text.data() + 1, text.data() + 7, rgb, 16).ptr != text.data() + 7) rgb = 0;
    return IM_COL32(rgb >> 16 & 255, rgb >> 8 & 255, rgb & 255, int(std::lround(255 * alpha)));
}

} // namespace blush
