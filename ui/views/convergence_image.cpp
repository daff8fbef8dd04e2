#include "ui/views/convergence_image.h"

#include "ui/gl/draw_list_image.h"
#include "ui/widgets/plot_drawing.h"

#include <fmt/format.h>

namespace blush {

ConvergencePlot export_chart(const ConvergenceView& view, const std::string& scene) {
    ConvergencePlot p = convergence_plot(view.runs, view.plot_options(false));
    p.plot.title = fmt::format("Error against {}: {}", view.axis == ProgressAxis::seconds ? "time" : "samples", scene);
    p.plot.width = 960;
    p.plot.height = 600;
    return p;
}

ChartImage draw_chart_image(const Plot& chart) {
    const ImFont& font = *ImGui::GetIO().Fonts->Fonts.front();
    const float size = font.FontSize, scale = size / 12; // the layout is made for an SVG with this font size
    Plot plot = chart;
    plot.title += plot.title.empty() ? plot.y_label : ",  " + plot.y_label; // the y label goes into the title: no vertical text
    plot.y_label.clear();
    ChartImage image{int(float(plot.width) * scale), int(float(plot.height) * scale), {}};
    ImDrawList list(ImGui::GetDrawListSharedData());
    list._ResetForNewFrame();
    list.PushClipRect({0, 0}, {float(image.width), float(image.height)});
    list.PushTextureID(ImGui::GetIO().Fonts->TexID);
    const PlotTones tones = plot_tones_paper();
    const PlotLayout l = compute_plot_layout(plot, plot_metrics({float(image.width), float(image.height)}, font, size, true));
    draw_plot(list, plot, l, {0, 0}, font, size, tones);
    image.rgb = rasterize(list, image.width, image.height, tones.ground);
    return image;
}

} // namespace blush
