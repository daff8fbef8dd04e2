// relMSE of what is on the screen at times after an edit, with and without the field of path guiding that the edit left over: two sessions
// in turns.
#include "tests/bench/bench.h"
#include "tests/bench/edits.h"
#include "tests/bench/quality/screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace blush::bench {
namespace {

constexpr int edit_step = 50;        // an edit that is plain to see: light times 1.5, camera by a twentieth of the distance
constexpr double refined_before = 1; // seconds between the image of the scene before the edit and the edit
constexpr std::array deadlines{0.033, 0.1, 0.3, 1.0};

// relMSE of the image, enlarged to the size of the reference.
double error_of(const Frame& frame, const std::vector<float>& truth, int width, int height) {
    double sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t from = 4 * (size_t(std::min(y / frame.divider, frame.height - 1)) * size_t(frame.width) +
                                     size_t(std::min(x / frame.divider, frame.width - 1)));
            const size_t to = 4 * (size_t(y) * size_t(width) + size_t(x));
            for (size_t c = 0; c < 3; ++c) {
                const double t = double(truth[to + c]), d = double(frame.rgba[from + c]) - t;
                sum += d * d / (t * t + 0.01);
            }
        }
    return sum / (3.0 * width * height);
}

using Errors = std::array<std::vector<double>, 2>; // of each round: without, with the field of before the edit

// Of the first sample after the edit, whatever time it takes.
Json of_first_sample(const Scene& before, const Scene& edited, RenderSettings settings, const std::vector<float>& truth,
                     const Options& options) {
    Errors errors;
    std::array<double, 2> rays{};
    for (int round = 0; round < options.rounds; ++round)
        for (size_t kept = 0; kept < 2; ++kept) {
            settings.seed = uint32_t(round);
            Renderer renderer({.threads = options.threads, .planes = {}, .begins_trained = kept == 1});
            renderer.update(before, settings);
            renderer.decide();
            renderer.update(edited, settings);
            renderer.render(0, 1);
            const Frame frame = renderer.resolve();
            errors[kept].push_back(error_of(frame, truth, settings.width, settings.height));
            rays[kept] += double(frame.rays.camera + frame.rays.bounce + frame.rays.shadow);
        }
    return {{"without", rounded(median(errors[0]))}, {"kept", rounded(median(errors[1]))}, {"rays", rounded(rays[1] / rays[0])}};
}

// Of what the session shows at the deadlines.
Json on_the_screen(const Scene& before, const Scene& edited, RenderSettings settings, const std::vector<float>& truth,
                   const Options& options) {
    std::array<Errors, deadlines.size()> errors;
    for (int round = 0; round < options.rounds; ++round)
        for (size_t kept = 0; kept < 2; ++kept) {
            Screen screen(options.threads, false, kept == 1);
            settings.seed = uint32_t(round);
            if (const auto shown = screen.show(before, settings, refined_before); !shown) throw std::runtime_error(shown.error().text());
            const AfterEdit after = checked(screen.edit(edited, settings, deadlines));
            for (size_t i = 0; i < deadlines.size(); ++i)
                errors[i][kept].push_back(error_of(*after.images[i].frame, truth, settings.width, settings.height));
        }
    Json result;
    for (size_t i = 0; i < deadlines.size(); ++i)
        result.push_back({{"ms", 1e3 * deadlines[i]}, {"without", rounded(median(errors[i][0]))}, {"kept", rounded(median(errors[i][1]))}});
    return result;
}

Json measure(const BenchScene& scene, const Options& options) {
    RenderSettings settings = window_settings();
    settings.width = 640;
    settings.height = 360;
    Json rows = Json::array();
    for (const EditKind& kind : edits_after_learning(scene.scene)) {
        Scene edited = scene.scene;
        kind.apply(edited, edit_step);
        Renderer renderer({.threads = options.threads, .planes = {}});
        settings.seed = 1000;
        renderer.update(edited, settings);
        renderer.render(0, options.reference_samples);
        const std::vector<float> truth = renderer.resolve().rgba;
        Json row{{"scene", scene.name()}, {"edit", kind.name}};
        row["first_sample"] = of_first_sample(scene.scene, edited, settings, truth, options);
        if (options.max_seconds > 0) row["screen"] = on_the_screen(scene.scene, edited, settings, truth, options);
        fmt::print(stderr, "  {}\n", row.dump());
        rows.push_back(row);
    }
    return rows;
}

} // namespace

Json run_after_edits(const Options& options) {
    Json result = Json::array();
    for (const BenchScene& scene : options.scenes)
        for (Json& row : measure(scene, options)) result.push_back(std::move(row));
    return result;
}

} // namespace blush::bench
