#include "render/renderer.h"

#include "core/parallel.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/expanded_lights.h"
#include "render/compile/render_scene.h"
#include "render/diagnostics/fault_finder.h"
#include "render/film/film.h"
#include "render/film/film_columns.h"
#include "render/film/film_state.h"
#include "render/film/pilot_variance.h"
#include "render/film/portal_choice.h"
#include "render/film/reuse_choice.h"
#include "render/film/reuse_pilot.h"
#include "render/film/sample_allocation.h"
#include "render/film/shadow_catcher.h"
#include "render/film/visibility_choice.h"
#include "render/film/visibility_pilot.h"
#include "render/integrator/irradiance.h"
#include "render/integrator/kernel_settings.h"
#include "render/integrator/reuse_groups.h"
#include "render/kernels/stage_timer.h"
#include "render/tile_shape.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace blush {
namespace {

using Clock = std::chrono::steady_clock;

bool hides_environment(const Environment& e) { return e.kind != Environment::Kind::none && !e.visible_to_camera; }

// True during the pilot, after its first half was stored.
bool in_mid_pilot(int64_t samples) { return samples >= SampleAllocation::pilot_samples / 2 && samples < SampleAllocation::pilot_samples; }

} // namespace

struct Renderer::State {
    RendererOptions options;
    Workers workers;
    std::vector<std::unique_ptr<TileScratch>> scratch;
    std::vector<std::unique_ptr<TileScratch>> replays; // for invalid samples
    std::vector<std::unique_ptr<CatcherScratch>> catching;
    RenderScene scene;
    std::optional<Scene> expanded;
    ExpandedMeshes meshes;
    RenderSettings settings;
    LightGroupsPtr groups; // null: no light mix
    Mixing mixing;         // of the groups
    Film film;
    SampleAllocation sample_allocation; // only for adaptive sampling, like the next
    PilotVariance pilot_variance;
    ReuseChoice reuse; // of the scene and settings, like the next
    VisibilityChoice visibility;
    PortalChoice portals;
    bool film_is_stale = true, film_is_uneven = false; // uneven: rendering stopped in the middle of a sample
    int divider = 1;
    const Kernel* kernel = nullptr;
    std::string kernel_name;
    double seconds_setup = 0;
    // Computed on request: it reads every triangle, too slow during a drag.
    std::optional<CompiledInfo> info;
    std::shared_ptr<const FeatureReport> feature_report; // null: must be computed
    int64_t samples = 0;
    RayCounts rays;
    StageSeconds stages; // since the film was cleared
    std::vector<PathCounts> path_counts;
    int64_t truncated = 0;

    explicit State(const RendererOptions& o)
        : options(o), workers(o.threads, o.low_priority), scratch(workers.threads()), replays(workers.threads()),
          catching(workers.threads()) {}

    int film_width() const { return std::max(1, settings.width / divider); }
    int film_height() const { return std::max(1, settings.height / divider); }
    // Without its seed.
    KernelContext context_for(const SceneTables& tables) const {
        KernelContext context{&tables, &scene.accel(), kernel_settings(settings, film_width(), film_height())};
        context.settings.filter_textures = options.filter_textures;
        return context;
    }
    bool decide(const std::function<bool()>& wanted);
    // With what the pilots have learned, for a sample of this index at full resolution.
    SceneTables learned_tables(int64_t sample) const { return portals.tables(visibility.tables(scene.tables(), sample), sample); }
    bool changes_after_first_sample() const {
        return divider == 1 && (visibility.pays() || portals.pays() || reuse_group_size(0) != reuse_group_size(1));
    }
    int reuse_group_size(int64_t sample) const { return divider == 1 ? reuse.group_size(sample) : reuse.first_group_size(); }

    FilmSize full_film() const {
        return {settings.width, settings.height, options.planes, transparent(), settings.adaptive, int(mixing.gains.size()), catches()};
    }
    // If the scene differs from the film only in the light mix, applies the mix and returns true.
    bool apply_mix(const Scene& whole, const RenderSettings& now) {
        if (!groups || !same_image(settings, now)) return false;
        std::optional<Mixing> mix = mixing_of(*groups, whole);
        if (!mix) return false;
        set_mix(*std::move(mix));
        settings = now;
        return true;
    }
    void set_mix(Mixing mix) {
        mixing = std::move(mix);
        film.set_gains(mixing.gains);
    }
    // Updates the compiled scene; true if the film is outdated.
    bool compile(const Scene& whole, const RenderSettings& now, LightGroupsPtr groups_of_scene);
    // Discards the samples; their setup began at `begun`.
    void begin_film(Clock::time_point begun);

    bool catches() const { return !scene.catchers().empty(); }
    // A caught shadow needs a background: without an environment the image is for compositing.
    bool transparent() const {
        return expanded &&
               (hides_environment(expanded->environment) || (catches() && expanded->environment.kind == Environment::Kind::none));
    }

    void clear() {
        film_is_stale = true;
        film_is_uneven = false;
        feature_report.reset();
        samples = 0;
        rays = {};
        stages = {};
        path_counts.clear();
        truncated = 0;
    }
    // Clearing a full-size film takes as long as rendering a coarse image, so it is delayed until the next draw or read: edits
    // often change the divider afterwards.
    void clear_stale_film() {
        if (!film_is_stale) return;
        FilmSize size = full_film();
        size.width = film_width();
        size.height = film_height();
        film.reset(size, settings.clamp);
        film.set_gains(mixing.gains);
        sample_allocation.reset(film_width(), film_height());
        film_is_stale = false;
    }
    // Samples first, first + stride, ... of a pixel, with these reuse groups.
    struct Run {
        int64_t first, count;
        int stride;
        ReuseGroups groups;
    };
    using Wanted = std::function<bool()>;
    using TileTask = std::function<bool(int tile, const TileJob& rectangle, unsigned worker)>;
    PixelRect rendered_pixels() const;
    // Null without a shadow catcher or if stopped. The bool functions below return false if stopped before the end.
    const CatcherColumns* shadows_of(const KernelContext& context, const TileJob& job, unsigned worker);
    bool render_run(TileJob rectangle, const Run& run, int most_samples, unsigned worker, const Wanted& wanted);
    bool for_each_tile(const TileShape& shape, const Wanted& wanted, const TileTask& task);
    bool render_uniformly(int64_t first, int64_t count, const Wanted& wanted);
    bool render_by_plan(int64_t first, int64_t count, const Wanted& wanted);

    TileScratch& scratch_of(unsigned worker) {
        if (!scratch[worker]) scratch[worker] = std::make_unique<TileScratch>();
        fit_columns(*scratch[worker], film);
        return *scratch[worker];
    }
};

Renderer::Renderer(const RendererOptions& options) : state_(std::make_unique<State>(options)) {}
Renderer::~Renderer() = default;

bool Renderer::State::compile(const Scene& whole, const RenderSettings& now, LightGroupsPtr groups_of_scene) {
    Scene now_expanded = expand_area_lights(whole, &meshes, &workers);
    const UpdatePlan todo = expanded ? plan(diff(*expanded, settings, now_expanded, now)) : full_plan();
    groups = std::move(groups_of_scene);
    mixing = groups ? mixing_of(*groups, whole).value() : Mixing{};
    Film::require_memory({now.width, now.height, options.planes, false, now.adaptive, int(mixing.gains.size())});
    scene.update(now_expanded, now, todo, workers, groups.get());
    if (groups) scene.aim(mixing.gains);
    expanded = std::move(now_expanded);
    settings = now;
    if (todo.features) kernel = &choose_kernel(scene.features());
    return todo.clear_film;
}

void Renderer::State::begin_film(Clock::time_point begun) {
    clear();
    reuse = ReuseChoice(settings, scene);
    visibility = VisibilityChoice(settings, scene);
    portals = PortalChoice(settings, scene);
    info.reset();
    kernel_name = std::string(kernel->isa) + "/" + std::string(kernel->name);
    seconds_setup = std::chrono::duration<double>(Clock::now() - begun).count();
}

bool Renderer::update(const Scene& scene, const RenderSettings& asked) {
    State& s = *state_;
    const RenderSettings settings = effective_settings(asked);
    const auto begun = Clock::now();
    if (s.apply_mix(scene, settings)) return false;
    const bool mixed = scene.mix.grouping != LightMix::Grouping::none;
    const bool outdated = s.compile(scene, settings, mixed ? std::make_shared<const LightGroups>(make_light_groups(scene)) : nullptr);
    if (outdated) s.begin_film(begun);
    return outdated;
}

void Renderer::begin_image(const Scene& scene, const RenderSettings& settings, LightGroupsPtr groups) {
    const auto begun = Clock::now();
    state_->compile(scene, effective_settings(settings), std::move(groups));
    state_->begin_film(begun);
}

void Renderer::set_mix(const Mixing& mixing) { state_->set_mix(mixing); }

void Renderer::select_lights_by_mix() {
    State& s = *state_;
    if (!s.groups) return;
    s.scene.aim(s.mixing.gains);
    s.visibility = VisibilityChoice(s.settings, s.scene);
    s.portals = PortalChoice(s.settings, s.scene);
}

void Renderer::set_planes(const PlaneSet& planes) {
    State& s = *state_;
    if (planes == s.options.planes) return;
    const bool covered = s.options.planes.covers(planes);
    s.options.planes = planes;
    s.info.reset();
    s.feature_report.reset();
    if (!covered)
        clear();
    else if (!s.film_is_stale)
        s.film.keep_only(planes);
}

void Renderer::set_divider(int divider) {
    if (divider == state_->divider) return;
    state_->divider = divider;
    clear();
}

int Renderer::divider() const { return state_->divider; }
void Renderer::clear() { state_->clear(); }

const CompiledInfo& Renderer::info() {
    State& s = *state_;
    if (!s.info) {
        s.info = s.scene.info();
        s.info->kernel = s.kernel_name;
        s.info->seconds_setup = s.seconds_setup;
    }
    s.info->features = *feature_report();
    return *s.info;
}

std::shared_ptr<const FeatureReport> Renderer::feature_report() {
    State& s = *state_;
    if (!s.feature_report) {
        FeatureReport feature_report = s.scene.feature_report(s.expanded ? *s.expanded : Scene{}, s.full_film());
        feature_report.push_back(s.reuse.report());
        feature_report.push_back(s.visibility.report());
        feature_report.push_back(s.portals.report());
        s.feature_report = std::make_shared<const FeatureReport>(std::move(feature_report));
    }
    return s.feature_report;
}

std::vector<Vec3> Renderer::resolve_error() {
    state_->clear_stale_film();
    return state_->film.standard_error();
}

ReuseCovariance Renderer::reuse_covariance() {
    state_->clear_stale_film();
    const int group_size = reuse_group_size(state_->settings, state_->reuse.pilot());
    return group_size > 1 ? measure_reuse_covariance(state_->film, reuse_groups(group_size)) : ReuseCovariance{};
}

bool Renderer::State::render_run(TileJob job, const Run& run, int most_samples, unsigned worker, const Wanted& wanted) {
    const SceneTables tables = learned_tables(divider == 1 ? run.first : 0);
    KernelContext context = context_for(tables);
    context.seed = settings.seed;
    context.settings.reuse = run.groups;
    TileScratch& tile = scratch_of(worker);
    const Film::Diagnose diagnose = [&](int x, int y, int64_t sample) {
        if (!replays[worker]) replays[worker] = std::make_unique<TileScratch>();
        return find_fault(context, x, y, sample, *replays[worker]);
    };
    job.stride = run.stride;
    for (int64_t done = 0; done < run.count; done += job.samples) {
        if (done > 0 && wanted && !wanted()) return false;
        job.first_sample = run.first + done * run.stride;
        job.samples = int(std::min<int64_t>(most_samples, run.count - done));
        kernel->render(context, job, tile);
        StageTimer timer(tile.stages);
        const CatcherColumns* shadows = shadows_of(context, job, worker);
        timer.end(Stage::shadow);
        film.add(job, tile, settings.seed, diagnose, shadows);
        timer.end(Stage::film);
    }
    return true;
}

// For the tile's samples; null without a shadow catcher.
const CatcherColumns* Renderer::State::shadows_of(const KernelContext& context, const TileJob& job, unsigned worker) {
    if (!catches()) return nullptr;
    if (!catching[worker]) catching[worker] = std::make_unique<CatcherScratch>();
    catch_shadows(context, scene.catchers(), job, *catching[worker]);
    return &catching[worker]->columns;
}

bool Renderer::has_light() const { return state_->scene.has_light(); }

Vec3d Renderer::irradiance(const MeterPlace& place, uint32_t replicate, int samples) {
    State& s = *state_;
    const KernelContext context{&s.scene.tables(), &s.scene.accel(), kernel_settings(s.settings, 1, 1), s.settings.seed};
    const Vec3d position = place.position + place.normal * place.clearance - s.scene.origin();
    const MeterPoint receiver{to_float(position), to_float(place.normal)};
    if (!s.replays[0]) s.replays[0] = std::make_unique<TileScratch>();
    Vec3d mean{0, 0, 0};
    s.workers.run([&] { mean = estimate_irradiance(context, receiver, replicate, samples, *s.replays[0]); });
    return mean;
}

// The rendered part of the film. Path reuse needs whole groups.
PixelRect Renderer::State::rendered_pixels() const {
    PixelRect r = pixels_of(settings.region, film.width(), film.height());
    if (reuse.first_group_size() <= 1) return r;
    const ReuseGroups groups = reuse_groups(reuse.first_group_size());
    const auto down = [](int x, int block) { return x / block * block; };
    const auto up = [](int x, int block) { return (x + block - 1) / block * block; };
    return {down(r.x0, groups.block_width), down(r.y0, groups.block_height), std::min(up(r.x1, groups.block_width), film.width()),
            std::min(up(r.y1, groups.block_height), film.height())};
}

bool Renderer::State::for_each_tile(const TileShape& shape, const Wanted& wanted, const TileTask& task) {
    const int across = (film.width() + shape.width - 1) / shape.width, down = (film.height() + shape.height - 1) / shape.height;
    const PixelRect wanted_pixels = rendered_pixels();
    const TickRate rate;
    std::atomic<bool> cut_short{false};
    const bool all_begun = workers.for_each(int64_t(across) * down, wanted, [&](int64_t tile, unsigned worker) {
        const int x = int(tile % across) * shape.width, y = int(tile / across) * shape.height;
        TileJob job;
        job.x = std::max(x, wanted_pixels.x0);
        job.y = std::max(y, wanted_pixels.y0);
        job.width = std::min(x + shape.width, wanted_pixels.x1) - job.x;
        job.height = std::min(y + shape.height, wanted_pixels.y1) - job.y;
        if (job.width <= 0 || job.height <= 0) return;
        if (!task(int(tile), job, worker)) cut_short = true;
    });
    for (const auto& used : catching)
        if (used) rays.shadow += std::exchange(used->tile.shadow_rays, 0);
    for (const auto& used : scratch) {
        if (!used) continue;
        const StageTicks spent = std::exchange(used->stages, {});
        add_seconds(stages, spent, rate.seconds_per_tick());
        rays.bounce += std::exchange(used->bounce_rays, 0);
        rays.shadow += std::exchange(used->shadow_rays, 0);
        rays.camera += std::exchange(used->camera_rays, 0);
        truncated += std::exchange(used->truncated_paths, 0);
        if (used->roulette) move_counts(used->roulette->counts, path_counts);
    }
    return all_begun && !cut_short;
}

// Renders the same samples for every pixel; path reuse is the same for all of them.
bool Renderer::State::render_uniformly(int64_t first, int64_t count, const Wanted& wanted) {
    const PixelRect pixels = rendered_pixels();
    const ReuseGroups groups = reuse_groups(reuse_group_size(first));
    const int64_t pixels_per_worker = int64_t(pixels.x1 - pixels.x0) * (pixels.y1 - pixels.y0) / workers.threads();
    const TileShape shape = groups.size() > 1 ? tile_shape(groups) : tile_shape(count, pixels_per_worker);
    return for_each_tile(shape, wanted, [&](int, const TileJob& job, unsigned worker) {
        return render_run(job, {first, count, 1, groups}, shape.samples, worker, wanted);
    });
}

// Renders the samples of each half of each tile by the sample plan.
bool Renderer::State::render_by_plan(int64_t first, int64_t count, const Wanted& wanted) {
    constexpr TileShape shape{SampleAllocation::tile_size, SampleAllocation::tile_size, 8};
    const ReuseGroups groups = reuse_groups_of_plan(reuse_group_size(first));
    return for_each_tile(shape, wanted, [&](int tile, const TileJob& job, unsigned worker) {
        for (int half = 0; half < 2; ++half) {
            const int64_t from = sample_allocation.samples(tile, half, first), to = sample_allocation.samples(tile, half, first + count);
            if (!render_run(job, {2 * from + half, to - from, 2, groups}, shape.samples, worker, wanted)) return false;
        }
        return true;
    });
}

bool Renderer::State::decide(const std::function<bool()>& wanted) {
    const auto pilot_context = [&](const SceneTables& tables) {
        KernelContext context = context_for(tables);
        context.settings.width = float(settings.width);
        context.settings.height = float(settings.height);
        return context;
    };
    if (visibility.needs_pilot()) {
        auto learned = learn_light_visibility(pilot_context(scene.tables()), *kernel, workers, replays, wanted);
        if (!learned) return false;
        visibility.decide(*std::move(learned));
        feature_report.reset();
    }
    if (portals.needs_pilot()) {
        const SceneTables tables = learned_tables(1);
        auto pilot = learn_portals(pilot_context(tables), *kernel, workers, replays, wanted);
        if (!pilot) return false;
        portals.decide(*std::move(pilot));
        feature_report.reset();
    }
    // Measures the samples as they will be rendered.
    if (reuse.needs_pilot()) {
        const SceneTables tables = learned_tables(1);
        const auto measured = measure_path_reuse(pilot_context(tables), *kernel, workers, replays, wanted);
        if (!measured) return false;
        reuse.decide(*measured);
        feature_report.reset();
    }
    return true;
}

bool Renderer::decide(const std::function<bool()>& wanted) { return state_->decide(wanted); }

bool Renderer::render(int64_t first, int64_t count, const std::function<bool()>& wanted) {
    State& s = *state_;
    s.clear_stale_film();
    const int64_t begin = s.settings.adaptive ? s.samples : first;
    if (s.divider == 1 && begin + count > 1 && !decide(wanted)) return false;
    for (int64_t done = 0; done < count;) {
        const int64_t next = begin + done;
        int64_t step = count - done;
        // Ends where the pilot of adaptive sampling is measured, and where the pilots' decisions apply.
        if (s.settings.adaptive) step = std::min(step, SampleAllocation::next_measurement(next) - next);
        if (next == 0 && s.changes_after_first_sample()) step = 1;
        const bool planned = s.settings.adaptive && s.sample_allocation.decided();
        if (!(planned ? s.render_by_plan(next, step, wanted) : s.render_uniformly(next, step, wanted))) return !(s.film_is_uneven = true);
        s.samples += step;
        done += step;
        if (!s.settings.adaptive) continue;
        if (s.samples == SampleAllocation::pilot_samples / 2) s.pilot_variance.mark(s.film);
        if (s.samples == SampleAllocation::pilot_samples) s.sample_allocation.decide(s.pilot_variance.measure(s.film));
    }
    return true;
}

void Renderer::resolve(Frame& frame) {
    State& s = *state_;
    s.clear_stale_film();
    s.film.resolve(frame, s.workers);
    for (uint32_t& id : frame.object_id) id &= ~expanded_id_bit;
    for (uint32_t& id : frame.material_id) {
        const uint32_t material = s.scene.material_id(int32_t(id) - 1).value;
        id = material & expanded_id_bit ? 0 : material;
    }
    frame.light_groups = s.groups;
    frame.group_names = s.mixing.names;
    frame.divider = s.divider;
    frame.whole = s.settings.region == ImageRegion{};
    frame.samples = s.samples;
    frame.rays = s.rays;
    frame.stages = s.stages;
    frame.path_counts = s.options.planes.roulette ? s.path_counts : std::vector<PathCounts>();
    frame.health.truncated = s.truncated;
    frame.kernel = s.kernel_name;
    frame.feature_report = feature_report();
    frame.missing_light = s.scene.missing_light();
    frame.warnings = s.scene.warnings();
}

Frame Renderer::resolve() {
    Frame frame;
    resolve(frame);
    frame.error = estimate_error();
    frame.error_samples = frame.samples;
    return frame;
}

ErrorEstimate Renderer::estimate_error() {
    State& s = *state_;
    s.clear_stale_film();
    ErrorEstimate error = blush::estimate_error(s.film, blush::reuse_group_size(s.settings, s.reuse.pilot()), s.workers);
    // Both halves miss the same light, so their difference does not show that error.
    if (!s.scene.missing_light().empty()) {
        error.known = error.known && error.high > 0;
        error.rmse_known = error.rmse_known && error.rmse_high > 0;
    }
    return error;
}

Result<FilmState> Renderer::save_film(int64_t first) const {
    const State& s = *state_;
    if (s.film_is_stale || s.samples == 0) return Error{"", "no samples are rendered yet", ""};
    if (s.film_is_uneven) return Error{"", "rendering was stopped in the middle of a sample", ""};
    if (s.divider != 1) return Error{"", "the image is not yet at full resolution", ""};
    FilmState state = blush::save_film(s.film);
    // A saved film starts with the current emission; mix channels are saved separately.
    if (std::ranges::any_of(s.mixing.factors, [](const Vec3& f) { return f != Vec3{1, 1, 1}; })) scale_groups(state, s.mixing.factors);
    if (LosslessPlane* material = state.find("material"))
        for (uint32_t& index : material->words)
            if (index != FilmState::no_material) index = s.scene.material_id(int32_t(index)).value;
    state.first_sample = first;
    state.samples = s.samples;
    state.shares = s.sample_allocation.shares();
    if (s.settings.adaptive && in_mid_pilot(s.samples)) state.marked = s.pilot_variance.marked();
    state.reuse_pilot = s.reuse.pilot();
    state.rays = s.rays;
    state.path_counts = s.path_counts;
    state.truncated = s.truncated;
    for (size_t k = 0; k < s.mixing.names.size(); ++k) state.mix.push_back({s.mixing.names[k], s.mixing.channels[k]});
    return state;
}

Result<void> Renderer::load_film(const FilmState& state) {
    State& s = *state_;
    s.divider = 1;
    s.clear();
    s.clear_stale_film();
    const auto refused = [&](Error error) {
        s.clear();
        return error;
    };
    if (state.samples < 1) return refused({"", "there are no samples", ""});
    const bool marked = s.settings.adaptive && in_mid_pilot(state.samples);
    if (marked && state.marked.size() != 2 * size_t(s.film.width()) * size_t(s.film.height()))
        return refused({"", "the saved samples lack the pilot of adaptive sampling", ""});
    const bool decided = s.settings.adaptive && state.samples >= SampleAllocation::pilot_samples;
    if (decided && !s.sample_allocation.restore(state.shares))
        return refused({"", "the saved samples lack the plan of adaptive sampling", ""});
    if (const auto loaded = blush::load_film(s.film, state); !loaded) return refused(loaded.error());
    s.film.each_material([&](int32_t& index) {
        if (uint32_t(index) != FilmState::no_material) index = s.scene.material_index(Id<Material>{uint32_t(index)});
    });
    if (marked) s.pilot_variance.restore(state.marked);
    if (state.reuse_pilot) s.reuse.decide(*state.reuse_pilot);
    s.samples = state.samples;
    s.rays = state.rays;
    s.path_counts = state.path_counts;
    s.truncated = state.truncated;
    return {};
}

std::vector<std::string> available_isas() {
    const auto isas = runnable_isas();
    return {isas.begin(), isas.end()};
}

} // namespace blush
