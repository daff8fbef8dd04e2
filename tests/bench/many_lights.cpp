// Many lights: variance of the light tree compared with an oracle and with power sampling, at single points and in an image, and
// the latency of edits of lights.
#include "tests/support/many_lights.h"
#include "tests/bench/bench.h"

#include "core/parallel.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"

namespace blush::bench {
Json run_many_lights(const Options& options) {
    Json result = Json::array();
    for (const int rooms : {3, 6, 20}) {
        const RenderSettings settings;
        Scene scene = expand_area_lights(test::house(rooms));
        RenderScene compiled;
        compiled.update(scene, settings, full_plan(), Workers(1));
        UpdatePlan relight;
        relight.lights = true;
        std::vector<double> seconds;
        for (int round = 0; round < options.rounds; ++round)
            seconds.push_back(cost_of([&] { compiled.update(scene, settings, relight, Workers(1)); }).core_seconds);
        const test::SelectionVariance v = test::choice_variance(compiled.tables(), rooms, 200);
        const test::ImageVariance image = test::image_variance(rooms, 64);
        result.push_back({{"lights", rooms * rooms * 25},
                          {"relative_variance", {{"oracle", rounded(v.oracle)}, {"tree", rounded(v.tree)}, {"power", rounded(v.power)}}},
                          {"tree_over_oracle", rounded(v.tree / v.oracle)},
                          {"power_over_tree", rounded(v.power / v.tree)},
                          {"image_rendered_over_oracle", rounded(image.rendered / image.oracle)},
                          {"image_power_over_rendered", rounded(image.power / image.rendered)},
                          {"relight_ms", rounded(median(seconds) * 1e3)}});
    }
    return result;
}

} // namespace blush::bench
