#include "render/diagnostics/highlight_pilot.h"

#include "core/math.h"
#include "render/diagnostics/replay.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

constexpr uint32_t highlight_pilot_seed = 0x9b05688cu; // any; it only has to differ from those of images
constexpr int num_highlight_paths = 16384, paths_per_task = 128, num_tasks = num_highlight_paths / paths_per_task;
constexpr int max_repeats = 64;
constexpr int max_chain = 8;                 // smooth surfaces in turn
constexpr float cone_height = 0.0340741737f; // 1 - cos(15 degrees)
constexpr Features features = all_features;

using HighlightBand = SmallHighlights::Band;
struct Meeting {
    double luminance;
    HighlightBand band;
};

// The light in the cone around the path's next ray, by one sampled point on a light.
std::optional<Meeting> meet_light(const KernelContext& context, const Path<float>& next, int bounce, TileScratch& scratch) {
    const SceneTables& scene = *context.scene;
    const Sampler<float> sampler{next.key, next.index};
    const Pair<float> random = sampler.pair(first_scatter_dimension + dimensions_per_scatter * uint32_t(bounce) + light_dimension);
    const auto& [origin, towards] = next.ray;
    const LightPoint<float> light = sample_light_point<features, float>(scene, random, {origin, towards}, true);
    if (!light.valid || light.delta) return std::nullopt;
    const Vec3 to = light.infinite ? light.position : light.position - origin;
    const float distance_squared = dot(to, to), distance = std::sqrt(distance_squared);
    const Vec3 wi = to / distance;
    if (!(1.f - dot(wi, towards) < cone_height)) return std::nullopt;
    const IncidentLight<float> in = incident_light<features, float>(scene, light, wi, distance_squared);
    const Vec3 radiance = next.beta * in.radiance;
    if (!(in.pdf > 0) || !has_light<float>(radiance)) return std::nullopt;

    Step<float> shadow{};
    shadow.direct = radiance;
    shadow.shadow = {origin, wi};
    shadow.shadow_distance = light.infinite ? infinity : distance * (1.f - 1e-4f);
    shadow.shadow_mask = other_ray_mask;
    const auto received = [&] { return Vec3d{scratch.r[0], scratch.g[0], scratch.b[0]}; };
    const Vec3d before = received();
    scratch.shadows.size = 0;
    if (scene.blends) scratch.shadows.random[0] = opacity_random<float>(next.key, next.index, bounce + 1);
    scratch.shadows.mask[0] = shadow.shadow_mask;
    append<float>(scratch.shadows, shadow, 0, true);
    connect_paths<features, float>(context, scratch, bounce);
    scratch.shadows.size = 0;
    const Vec3d arrived = received() - before;
    const double luminance_arrived = luminance(arrived);
    if (!(luminance_arrived > 0) || !std::isfinite(luminance_arrived)) return std::nullopt;
    const double rate = 1 / (double(in.pdf) * 2 * std::numbers::pi * double(cone_height));
    return Meeting{luminance_arrived, {rate, arrived * rate}};
}

class HighlightPilot {
public:
    HighlightPilot(const KernelContext& context, const Workers& workers, std::vector<std::unique_ptr<TileScratch>>& scratch,
                   const std::function<bool()>& wanted)
        : context_(context), workers_(workers), scratch_(scratch), wanted_(wanted) {
        context_.seed = highlight_pilot_seed;
        for (auto& s : scratch_)
            if (!s) s = std::make_unique<TileScratch>();
    }

    std::optional<SmallHighlights> find();

private:
    // Sample `repeat` of path `i`: appends the light that it meets. Returns true if a smooth surface turns it.
    bool follow(int i, int repeat, TileScratch& scratch, std::vector<Meeting>& met) const;

    KernelContext context_;
    const Workers& workers_;
    std::vector<std::unique_ptr<TileScratch>>& scratch_;
    const std::function<bool()>& wanted_;
};

bool HighlightPilot::follow(int i, int repeat, TileScratch& scratch, std::vector<Meeting>& met) const {
    // The R2 sequence (Roberts 2018) spreads the paths evenly over images of any shape.
    const double u = i * 0.7548776662466927, v = i * 0.5698402909980532;
    const auto pixel = [](double at, float size) { return std::min(int((at - std::floor(at)) * double(size)), int(size) - 1); };
    const int x = pixel(u, context_.settings.width), y = pixel(v, context_.settings.height);
    bool turned = false;
    replay_sample(context_, x, y, i + int64_t(repeat) * num_highlight_paths, max_chain, scratch, [&](const ReplayedVertex& vertex) {
        if (!vertex.step.continues || vertex.step.next.pdf < infinity) return false;
        turned = true;
        if (const auto light = meet_light(context_, vertex.step.next, vertex.bounce, scratch)) met.push_back(*light);
        return true;
    });
    return turned;
}

std::optional<SmallHighlights> HighlightPilot::find() {
    std::vector<std::vector<Meeting>> met(num_tasks);
    std::vector<std::vector<int>> turned(num_tasks);
    const auto for_each_task = [&](const auto& run) {
        return workers_.for_each(num_tasks, wanted_, [&](int64_t task, unsigned worker) { run(size_t(task), *scratch_[worker]); });
    };
    if (!for_each_task([&](size_t task, TileScratch& scratch) {
            for (int i = int(task) * paths_per_task; i < int(task + 1) * paths_per_task; ++i)
                if (follow(i, 0, scratch, met[task])) turned[task].push_back(i);
        }))
        return std::nullopt;
    size_t num_turned = 0;
    for (const auto& paths : turned) num_turned += paths.size();
    if (num_turned == 0) return SmallHighlights{};
    const int repeats = std::clamp(int(size_t(num_highlight_paths) / num_turned), 1, max_repeats);
    if (!for_each_task([&](size_t task, TileScratch& scratch) {
            for (const int i : turned[task])
                for (int repeat = 1; repeat <= repeats; ++repeat) follow(i, repeat, scratch, met[task]);
        }))
        return std::nullopt;

    SmallHighlights found;
    const double share = 1 / (double(num_highlight_paths) * (repeats + 1));
    for (const auto& meetings : met)
        for (const Meeting& m : meetings) {
            HighlightBand& band = found.of(m.luminance);
            band.rate += m.band.rate * share;
            band.sum = band.sum + m.band.sum * share;
        }
    return found;
}

} // namespace

std::optional<SmallHighlights> find_small_highlights(const KernelContext& context, const Workers& workers,
                                                     std::vector<std::unique_ptr<TileScratch>>& scratch,
                                                     const std::function<bool()>& wanted) {
    return HighlightPilot(context, workers, scratch, wanted).find();
}

} // namespace blush
