// The light mix: time to remix, render cost of the planes, and their memory.
#include "tests/bench/bench.h"

#include "core/parallel.h"
#include "render/film/film.h"
#include "render/light_mix/light_mix.h"
#include "render/renderer.h"

#include <algorithm>

namespace blush::bench {
namespace {

constexpr int groups = 8;

// A frame of the window's size with constant planes.
Frame frame_with_groups() {
    const RenderSettings settings = window_settings();
    Frame frame;
    frame.width = settings.width;
    frame.height = settings.height;
    const size_t pixels = size_t(frame.width) * size_t(frame.height);
    frame.rgba.assign(4 * pixels, 1.f);
    for (int k = 0; k < groups; ++k) frame.groups.emplace_back(pixels, Vec3{0.1f * float(k), 0.5f, 1});
    frame.gains.assign(groups, {1, 1, 1});
    return frame;
}

Json time_of_mixing(const Options& options) {
    const Frame frame = frame_with_groups();
    Json result;
    for (unsigned threads = 1; threads <= options.threads; threads *= 2) {
        const Workers workers(threads);
        std::vector<double> seconds;
        std::vector<float> mixed;
        for (int round = 0; round < 3 * options.rounds; ++round) {
            Gains gains(groups, Vec3{0.5f + 0.01f * float(round), 1, 1});
            const auto begin = Clock::now();
            mix_rgba(frame, gains, mixed, &workers);
            seconds.push_back(seconds_since(begin));
        }
        result[std::to_string(threads)] = {{"median_ms", rounded(1e3 * median(seconds))},
                                           {"worst_ms", rounded(1e3 * quantile(seconds, 1))}};
    }
    return result;
}

// CPU seconds with groups divided by those without, measured in turn.
double cost_of_planes(const Scene& plain, int& count) {
    Scene grouped = plain;
    grouped.mix.grouping = LightMix::Grouping::by_light;
    RenderSettings settings = rate_settings();
    Renderer with({.threads = 1, .planes = {}}), without({.threads = 1, .planes = {}});
    with.update(grouped, settings);
    without.update(plain, settings);
    count = int(make_light_groups(grouped).groups.size());
    std::vector<double> ratios;
    for (int round = 0; round < 5; ++round) {
        const double bare = cost_of([&] { without.render(8 * round, 8); }).core_seconds;
        ratios.push_back(cost_of([&] { with.render(8 * round, 8); }).core_seconds / bare);
    }
    return median(ratios);
}

} // namespace

Json run_mix(const Options& options) {
    const RenderSettings window = window_settings();
    const double pixels = double(window.width) * window.height * 1e-6;
    Json result{{"groups", groups},
                {"update_by_threads", time_of_mixing(options)},
                {"film_mb_a_group", rounded(pixels * double(GroupPlanes::bytes_per_pixel(1)))},
                {"frame_mb_a_group", rounded(pixels * double(sizeof(Vec3)))}};
    for (const BenchScene& scene : options.scenes) {
        if (!scene.ours) continue;
        int count = 0;
        const double ratio = cost_of_planes(scene.scene, count);
        result["rendering"].push_back({{"scene", scene.name()}, {"groups", count}, {"core_seconds_over_plain", rounded(ratio)}});
    }
    return result;
}

} // namespace blush::bench
