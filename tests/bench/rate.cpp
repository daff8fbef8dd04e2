// Rays per second of the whole renderer, compared with Embree alone on the same rays. Rounds of the two alternate, so that other
// load on the machine affects both.
#include "tests/bench/bench.h"
#include "tests/bench/recorded_rays.h"

#include "render/compile/expand_area_lights.h"
#include "render/compile/kernel_speed.h"
#include "render/compile/render_scene.h"
#include "render/integrator/kernel_settings.h"
#include "render/renderer.h"

#include <set>

namespace blush::bench {
namespace {

constexpr int samples_per_round = 8;

// One scene compiled twice: for the renderer, and for tracing its recorded rays.
struct Contest {
    RenderSettings settings = rate_settings();
    Renderer renderer;
    Workers workers;
    RenderScene compiled;
    RecordedRays rays;

    Contest(const Scene& scene, unsigned threads) : renderer({.threads = threads, .planes = {}}), workers(threads) {
        renderer.update(scene, settings);
        compiled.update(expand_area_lights(scene), settings, full_plan(), workers);
        const KernelContext context{&compiled.tables(), &compiled.accel(), kernel_settings(settings, settings.width, settings.height),
                                    settings.seed};
        rays = record_rays(context, sample_tiles(settings, 7), workers);
    }
};

struct Round {
    double paths = 0, rays = 0;
    Cost render;
    std::array<double, ray_kinds.size()> replay_core_seconds{};
    double embree_core_seconds() const { return replay_core_seconds[0] + replay_core_seconds[1] + replay_core_seconds[2]; }
};

void replay_all(const Contest& contest, Round& round) {
    for (const RayKind kind : ray_kinds)
        round.replay_core_seconds[size_t(kind)] +=
            cost_of([&] { replay(contest.compiled.accel(), contest.rays, kind, contest.workers); }).core_seconds;
}

// Replays before and after the render, so that a machine that slows down steadily affects both.
Round play_round(Contest& contest) {
    Round round;
    replay_all(contest, round);
    contest.renderer.clear();
    round.render = cost_of([&] { contest.renderer.render(0, samples_per_round); });
    replay_all(contest, round);
    for (double& seconds : round.replay_core_seconds) seconds /= 2;
    round.rays = double(contest.renderer.resolve().rays.total());
    round.paths = double(contest.settings.width) * contest.settings.height * samples_per_round;
    return round;
}

template <class Value> Json median_of(const std::vector<Round>& rounds, const Value& value) {
    std::vector<double> values;
    for (const Round& round : rounds) values.push_back(value(round));
    return rounded(median(values));
}

// Million rays per second per core.
Json embree_rates(const Contest& contest, const std::vector<Round>& rounds) {
    const auto rate = [&](RayKind kind) {
        const double count = double(count_rays(contest.rays[size_t(kind)]));
        return median_of(rounds, [&](const Round& r) { return count / r.replay_core_seconds[size_t(kind)] / 1e6; });
    };
    return {{"camera", rate(RayKind::camera)}, {"bounce", rate(RayKind::bounce)}, {"shadow", rate(RayKind::shadow)}};
}

Json figures_of(const Contest& contest, const std::vector<Round>& rounds) {
    double recorded = 0;
    for (const auto& batches : contest.rays) recorded += double(count_rays(batches));
    const auto rendered = [](const Round& r) { return r.rays / r.render.core_seconds; };
    const auto embree = [&](const Round& r) { return recorded / r.embree_core_seconds(); };
    std::vector<double> ratios;
    for (const Round& r : rounds) ratios.push_back(rendered(r) / embree(r));
    return {{"million_paths_per_second", median_of(rounds, [](const Round& r) { return r.paths / r.render.wall_seconds / 1e6; })},
            {"million_rays_per_second", median_of(rounds, [](const Round& r) { return r.rays / r.render.wall_seconds / 1e6; })},
            {"rays_per_path", median_of(rounds, [](const Round& r) { return r.rays / r.paths; })},
            {"million_rays_per_core_second", median_of(rounds, [&](const Round& r) { return rendered(r) / 1e6; })},
            {"embree_million_rays_per_core_second", median_of(rounds, [&](const Round& r) { return embree(r) / 1e6; })},
            {"embree_by_kind", embree_rates(contest, rounds)},
            {"ratio_to_embree", rounded(median(ratios))},
            {"ratio_quartiles", {rounded(quantile(ratios, 0.25)), rounded(quantile(ratios, 0.75))}}};
}

// Core seconds of each stage over those of all, of the last round.
Json stage_shares(Contest& contest) {
    const StageSeconds stages = contest.renderer.resolve().stages;
    double all = 0;
    for (const double seconds : stages.of) all += seconds;
    Json shares;
    for (size_t k = 0; k < stage_names.size(); ++k) shares[std::string(stage_names[k])] = rounded(stages.of[k] / all);
    return shares;
}

bool is_measured(const BenchScene& scene) { return !scene.ours || scene.name() == "cornell.gltf"; }

} // namespace

Json run_rate(const Options& options) {
    Json result = Json::array();
    std::vector<BenchScene> scenes = options.scenes;
    for (BenchScene& scene : generated_scenes())
        if (scene.name().find(options.only) != std::string::npos) scenes.push_back(std::move(scene));
    for (const BenchScene& scene : scenes) {
        if (!is_measured(scene)) continue;
        for (const unsigned threads : std::set{1u, options.threads}) {
            Contest contest(scene.scene, threads);
            play_round(contest); // warms up pages, caches and clock rates
            std::vector<Round> rounds;
            for (int i = 0; i < options.rounds; ++i) rounds.push_back(play_round(contest));
            Json figures{{"scene", scene.name()}, {"threads", threads}, {"kernel", contest.renderer.info().kernel}};
            figures.update(figures_of(contest, rounds));
            figures["stages"] = stage_shares(contest);
            result.push_back(figures);
        }
    }
    return result;
}

} // namespace blush::bench
