#include "measure/plot/plot_svg.h"

#include "measure/plot/plot_layout.h"

#include <fmt/format.h>

namespace blush {
namespace {

std::string points_of(const std::vector<PlotPixel>& line) {
    std::string text;
    for (const PlotPixel& p : line) text += fmt::format("{}{:.1f},{:.1f}", text.empty() ? "" : " ", p.x, p.y);
    return text;
}

std::string dashes(PlotCurve::Line line) {
    switch (line) {
    case PlotCurve::Line::solid: return "";
    case PlotCurve::Line::dashed: return " stroke-dasharray='5 4'";
    case PlotCurve::Line::dotted: return " stroke-dasharray='1.5 3'";
    }
    return "";
}

std::string text_at(const PlotPixel& at, const char* anchor, const std::string& text, const char* kind = "legend") {
    return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' class='{}'>{}</text>\n", at.x, at.y, anchor, kind,
                       escaped_markup(text));
}

void draw_axes(std::string& svg, const Plot& plot, const PlotLayout& l) {
    for (const PlotTick& t : l.x_ticks) {
        svg += fmt::format("<line x1='{0:.1f}' y1='{1}' x2='{0:.1f}' y2='{2}' class='{3}'/>\n", t.at, l.top, l.bottom,
                           t.major ? "major" : "minor");
        if (!t.text.empty()) svg += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>{}</text>\n", t.at, l.bottom + 17, t.text);
    }
    for (const PlotTick& t : l.y_ticks) {
        svg += fmt::format("<line x1='{1}' y1='{0:.1f}' x2='{2}' y2='{0:.1f}' class='{3}'/>\n", t.at, l.left, l.right,
                           t.major ? "major" : "minor");
        if (!t.text.empty()) svg += fmt::format("<text x='{}' y='{:.1f}' text-anchor='end'>{}</text>\n", l.left - 7, t.at + 4, t.text);
    }
    svg += fmt::format("<rect x='{}' y='{}' width='{}' height='{}' class='box'/>\n", l.left, l.top, l.right - l.left, l.bottom - l.top);
    svg += fmt::format("<text x='{}' y='20' class='title'>{}</text>\n", l.left, escaped_markup(plot.title));
    svg += fmt::format("<text x='{}' y='{}' text-anchor='middle'>{}</text>\n", (l.left + l.right) / 2, plot.height - 12,
                       escaped_markup(plot.x_label));
    svg += fmt::format("<text transform='translate(18 {}) rotate(-90)' text-anchor='middle'>{}</text>\n", (l.top + l.bottom) / 2,
                       escaped_markup(plot.y_label));
}

void draw_curve(std::string& svg, const PlotCurve& curve, const PlotLayout::Curve& c) {
    const bool guide = curve.dots == PlotCurve::Dots::none;
    if (!c.band.empty()) svg += fmt::format("<polygon points='{}' fill='{}' fill-opacity='0.16'/>\n", points_of(c.band), curve.color);
    svg += fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='{}'{}/>\n", points_of(c.line), curve.color,
                       guide ? 1.2 : 1.8, dashes(curve.line));
    const bool hollow = curve.dots == PlotCurve::Dots::hollow;
    for (const PlotPixel& p : c.dots)
        svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='2.6' fill='{}'{}/>\n", p.x, p.y, hollow ? "#ffffff" : curve.color,
                           hollow ? fmt::format(" stroke='{}' stroke-width='1.3'", curve.color) : std::string());
}

void draw_lines(std::string& svg, const PlotLayout& l) {
    for (const PlotLayout::Mark& m : l.marks) {
        svg += fmt::format("<line x1='{0:.1f}' y1='{1}' x2='{0:.1f}' y2='{2}' stroke='{3}' stroke-dasharray='2 3'/>\n", m.at, l.top,
                           l.bottom, m.color);
        if (!m.label.empty()) svg += text_at(m.text, "start", m.label);
    }
    for (const PlotLayout::Level& level : l.levels) {
        svg += fmt::format("<line x1='{1}' y1='{0:.1f}' x2='{2}' y2='{0:.1f}' stroke='#444' stroke-dasharray='7 4'/>\n", level.at, l.left,
                           l.right);
        svg += text_at(level.text, "end", level.label);
    }
}

void draw_legend(std::string& svg, const Plot& plot, const PlotLayout& l) {
    for (const PlotLayout::Entry& e : l.legend) {
        const PlotCurve& c = plot.curves[e.curve];
        svg += fmt::format("<line x1='{0:.1f}' y1='{1:.1f}' x2='{2:.1f}' y2='{1:.1f}' stroke='{3}' stroke-width='2.4'{4}/>\n",
                           e.text.x - 1.25 * l.legend_sample, e.text.y - 4, e.text.x - 0.25 * l.legend_sample, c.color, dashes(c.line));
        svg += text_at(e.text, "start", c.name);
    }
}

} // namespace

std::string to_svg(const Plot& plot) {
    const PlotLayout l = compute_plot_layout(plot, {double(plot.width), double(plot.height), 12, true, {}});
    std::string svg = fmt::format("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
                                  "font-family='system-ui, sans-serif' font-size='12' fill='#333'>\n",
                                  plot.width, plot.height);
    svg += "<style>.minor{stroke:#eeeeee}.major{stroke:#d5d5d5}.box{fill:none;stroke:#999999}.title{font-size:14px;font-weight:600}"
           ".legend{paint-order:stroke;stroke:#ffffff;stroke-width:3px}</style>\n";
    svg += fmt::format("<rect width='{}' height='{}' fill='#ffffff'/>\n", plot.width, plot.height);
    draw_axes(svg, plot, l);
    for (const PlotLayout::Curve& c : l.curves) draw_curve(svg, plot.curves[c.index], c);
    draw_lines(svg, l);
    draw_legend(svg, plot, l);
    return svg + "</svg>\n";
}

std::string escaped_markup(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&': result += "&amp;"; break;
        case '<': result += "&lt;"; break;
        case '>': result += "&gt;"; break;
        case '"': result += "&quot;"; break;
        case '\'': result += "&#39;"; break;
        default: result += (unsigned char)c < 0x20 ? ' ' : c;
        }
    }
    return result;
}

} // namespace blush
