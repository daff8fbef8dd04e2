#include "tests/bench/quality/quality_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace blush::bench {

Plot quality_plot(const Json& quality) {
    Plot plot;
    plot.title = fmt::format("Time to quality after an edit, {}x{}, {} threads", quality.value("width", 0), quality.value("height", 0),
                             quality.value("threads", 0));
    plot.x_label = "milliseconds after the edit";
    plot.y_label = "FLIP of what is on the screen, mean over edits";
    plot.width = 800, plot.height = 560;
    struct Sum {
        double flip = 0;
        int edits = 0;
    };
    std::map<std::pair<std::string, std::string>, std::map<double, Sum>> sums; // by scene and image, then by milliseconds
    std::vector<std::string> scenes;
    for (const Json& row : quality.at("curves")) {
        if (!row.contains("flip")) continue;
        const std::string scene = row.at("scene");
        if (std::ranges::find(scenes, scene) == scenes.end()) scenes.push_back(scene);
        for (size_t i = 0; i < row.at("flip").size(); ++i) {
            Sum& sum = sums[{scene, row.at("image")}][row.at("ms").at(i)];
            sum.flip += row.at("flip").at(i).get<double>();
            ++sum.edits;
        }
    }
    for (const auto& [which, at] : sums) {
        const auto& [scene, image] = which;
        PlotCurve curve;
        curve.name = scene + ", " + image;
        curve.color = plot_color(size_t(std::ranges::find(scenes, scene) - scenes.begin()));
        curve.line = image == "raw"        ? PlotCurve::Line::dashed
                     : image == "denoised" ? PlotCurve::Line::solid
                                           : PlotCurve::Line::dotted; // of a peer
        for (const auto& [ms, sum] : at) curve.points.push_back({ms, sum.flip / sum.edits});
        plot.curves.push_back(std::move(curve));
    }
    return plot;
}

} // namespace blush::bench
