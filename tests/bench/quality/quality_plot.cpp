#include "tests/bench/quality/quality_plot.h"

#include "measure/plot/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace blush::bench {
namespace {

constexpr int columns = 3, panel_width = 400, panel_height = 290;

// Mean FLIP by milliseconds.
class MeanFlip {
public:
    void add(const Json& row) {
        for (size_t i = 0; i < row.at("flip").size(); ++i) {
            auto& [sum, count] = at_[row.at("ms").at(i)];
            sum += row.at("flip").at(i).get<double>();
            ++count;
        }
    }
    std::vector<PlotCurve::Point> points() const {
        std::vector<PlotCurve::Point> points;
        for (const auto& [ms, at] : at_) points.push_back({ms, at.first / at.second});
        return points;
    }

private:
    std::map<double, std::pair<double, int>> at_;
};

using SceneCurves = std::map<std::string, MeanFlip>; // by image

Plot plot_of(const std::string& scene, const SceneCurves& means) {
    Plot plot;
    plot.title = scene.substr(0, scene.find('.'));
    plot.x_label = "milliseconds after the edit";
    plot.y_label = "FLIP of what is on the screen";
    plot.width = panel_width, plot.height = panel_height;
    for (const auto& [image, mean] : means) {
        const size_t kind = image == "denoised" ? 0 : image == "raw" ? 1 : 2;
        PlotCurve curve;
        curve.name = image;
        curve.color = plot_color(kind);
        curve.line = kind == 0 ? PlotCurve::Line::solid : kind == 1 ? PlotCurve::Line::dashed : PlotCurve::Line::dotted;
        curve.points = mean.points();
        plot.curves.push_back(std::move(curve));
    }
    return plot;
}

} // namespace

std::string quality_chart(const Json& quality) {
    std::vector<std::pair<std::string, SceneCurves>> scenes; // in the order of the rows
    for (const Json& row : quality.at("curves")) {
        if (!row.contains("flip")) continue;
        const std::string scene = row.at("scene");
        auto found = std::ranges::find(scenes, scene, [](const auto& s) { return s.first; });
        if (found == scenes.end()) found = scenes.insert(scenes.end(), {scene, {}});
        found->second[row.at("image")].add(row);
    }
    const int rows = (int(scenes.size()) + columns - 1) / columns;
    std::string svg = fmt::format("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}'>\n",
                                  columns * panel_width, rows * panel_height);
    for (size_t i = 0; i < scenes.size(); ++i) {
        const int at = int(i);
        svg += fmt::format("<g transform='translate({} {})'>\n{}</g>\n", at % columns * panel_width, at / columns * panel_height,
                           to_svg(plot_of(scenes[i].first, scenes[i].second)));
    }
    return svg + "</svg>\n";
}

} // namespace blush::bench
