#include "render/diagnostics/highlight_pilot.h"

#include "core/math.h"
#include "render/diagnostics/replay.h"
#include "render/film/edge_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

constexpr uint32_t highlight_pilot_seed = 0x9b05688cu; // any; it only has to differ from those of images
// Cells are squares of pixels. One path of each finds the smooth surfaces; the others look for lamps.
constexpr int most_cells = 16384, num_repeats = 65536, most_per_cell = 1024;
constexpr int cells_per_task = 64;
constexpr float cone_height = 0.0340741737f; // 1 - cos(15 degrees)
constexpr Features features = all_features;

using HighlightBand = SmallHighlights::Band;
// Light that a path nearly met, as a share of the samples of its pixel.
struct Meeting {
    float apart;
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
    const float apart = 1.f - dot(wi, towards);
    if (!(apart < cone_height)) return std::nullopt;
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
    return Meeting{apart, luminance_arrived, {rate, arrived * rate}};
}

class HighlightPilot {
public:
    HighlightPilot(const KernelContext& context, const Workers& workers, std::vector<std::unique_ptr<TileScratch>>& scratch,
                   const std::function<bool()>& wanted)
        : context_(context), workers_(workers), scratch_(scratch), wanted_(wanted) {
        context_.seed = highlight_pilot_seed;
        restrict_to_emission(context_, tables_, longest_highlight_chain);
        side_ = std::max(1, int(std::ceil(std::sqrt(double(width()) * double(height()) / most_cells))));
        across_ = (width() + side_ - 1) / side_;
        down_ = (height() + side_ - 1) / side_;
        for (auto& s : scratch_)
            if (!s) s = std::make_unique<TileScratch>();
    }

    std::optional<Sightings> find();

private:
    int width() const { return int(context_.settings.width); }
    int height() const { return int(context_.settings.height); }
    PixelRect cell(int i) const {
        const int x = i % across_ * side_, y = i / across_ * side_;
        return {x, y, std::min(x + side_, width()), std::min(y + side_, height())};
    }
    // Runs `run(cell, scratch)` for `count` cells; false if not wanted any more.
    template <class Run> bool for_each_cell(size_t count, const Run& run) const {
        const int64_t tasks = int64_t(count + cells_per_task - 1) / cells_per_task;
        return workers_.for_each(tasks, wanted_, [&](int64_t task, unsigned worker) {
            const size_t begin = size_t(task) * cells_per_task;
            for (size_t i = begin; i < std::min(begin + cells_per_task, count); ++i) run(i, *scratch_[worker]);
        });
    }
    // The cells in which a smooth surface turned the first path, and those beside them.
    std::vector<int> near(const std::vector<uint8_t>& turned) const;
    // Path `repeat` of a cell: appends the lamps that it nearly meets; null: does not look for them. Returns true if a smooth surface turns
    // it.
    bool follow(int i, int repeat, TileScratch& scratch, std::vector<Sighting>* met) const;

    KernelContext context_;
    SceneTables tables_;
    int side_, across_, down_;
    const Workers& workers_;
    std::vector<std::unique_ptr<TileScratch>>& scratch_;
    const std::function<bool()>& wanted_;
};

bool HighlightPilot::follow(int i, int repeat, TileScratch& scratch, std::vector<Sighting>* met) const {
    // The R2 sequence (Roberts 2018) spreads the paths evenly over the cell.
    const int64_t index = i + int64_t(repeat) * most_cells;
    const auto pixel = [&](double step, int begin, int end) {
        const double at = double(index) * step;
        return std::min(begin + int((at - std::floor(at)) * (end - begin)), end - 1);
    };
    const PixelRect in = cell(i);
    const int x = pixel(0.7548776662466927, in.x0, in.x1), y = pixel(0.5698402909980532, in.y0, in.y1);
    bool turned = false;
    replay_sample(context_, x, y, index, longest_highlight_chain, scratch, [&](const ReplayedVertex& vertex) {
        if (!vertex.step.continues || vertex.step.next.pdf < infinity) return false;
        turned = true;
        if (!met) return false;
        if (const auto light = meet_light(context_, vertex.step.next, vertex.bounce, scratch))
            met->push_back({x, y, light->apart, light->luminance, light->band});
        return true;
    });
    return turned;
}

std::vector<int> HighlightPilot::near(const std::vector<uint8_t>& turned) const {
    std::vector<int> cells;
    for (int i = 0; i < across_ * down_; ++i) {
        const int x = i % across_, y = i / across_;
        bool any = false;
        for (int v = std::max(0, y - 1); v <= std::min(down_ - 1, y + 1); ++v)
            for (int u = std::max(0, x - 1); u <= std::min(across_ - 1, x + 1); ++u) any = any || turned[size_t(v * across_ + u)];
        if (any) cells.push_back(i);
    }
    return cells;
}

std::optional<Sightings> HighlightPilot::find() {
    std::vector<uint8_t> turned(size_t(across_) * size_t(down_));
    if (!for_each_cell(turned.size(), [&](size_t i, TileScratch& scratch) {
            // It does not count as one of the cell's paths: these are chosen by it.
            turned[i] = follow(int(i), 0, scratch, nullptr);
        }))
        return std::nullopt;
    const std::vector<int> cells = near(turned);
    if (cells.empty()) return Sightings{};
    const int repeats = std::clamp(int(size_t(num_repeats) / cells.size()), 1, most_per_cell);
    std::vector<std::vector<Sighting>> met(cells.size());
    if (!for_each_cell(cells.size(), [&](size_t k, TileScratch& scratch) {
            for (int repeat = 0; repeat < repeats; ++repeat) follow(cells[k], repeat + 1, scratch, &met[k]);
        }))
        return std::nullopt;

    Sightings found;
    found.spacing = side_ / std::sqrt(double(repeats));
    for (size_t k = 0; k < met.size(); ++k) {
        const PixelRect in = cell(cells[k]);
        const double share = double(in.x1 - in.x0) * double(in.y1 - in.y0) / (double(width()) * double(height()) * repeats);
        for (Sighting m : met[k]) {
            m.band = {m.band.rate * share, m.band.sum * share};
            found.all.push_back(m);
        }
    }
    return found;
}

} // namespace

std::optional<Sightings> find_small_highlights(const KernelContext& context, const Workers& workers,
                                               std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted) {
    return HighlightPilot(context, workers, scratch, wanted).find();
}

SmallHighlights highlights_of(const Sightings& sightings) {
    SmallHighlights all;
    for (const Sighting& s : sightings.all) all.add(s.luminance, s.band);
    return all;
}

} // namespace blush
