// What a Renderer holds, for the files that implement it.
#pragma once

#include "core/parallel.h"
#include "core/ticks.h"
#include "render/comparison/make_integrator.h"
#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/error/small_highlights.h"
#include "render/film/edges/edge_samples.h"
#include "render/film/film.h"
#include "render/film/film_columns.h"
#include "render/film/pilot_variance.h"
#include "render/film/sample_allocation.h"
#include "render/film/shadow_catcher.h"
#include "render/pilots/edges/edge_choice.h"
#include "render/pilots/learned_sampling.h"
#include "render/renderer.h"
#include "render/tile_shape.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace blush {

struct Renderer::State {
    using Clock = std::chrono::steady_clock;

    RendererOptions options;
    Workers workers;
    std::vector<std::unique_ptr<TileScratch>> scratch;
    std::vector<std::unique_ptr<TileScratch>> replays; // for invalid samples
    std::vector<std::unique_ptr<CatcherScratch>> catching;
    std::vector<std::unique_ptr<EdgeScratch>> at_edges;
    RenderScene scene;
    std::optional<Scene> expanded;
    ExpandedMeshes meshes;
    FieldEffect field_effect; // of the last edit
    RenderSettings settings;
    LightGroupsPtr groups; // null: no light mix
    Mixing mixing;         // of the groups
    Film film;
    SampleAllocation sample_allocation; // only for adaptive sampling, like the next
    PilotVariance pilot_variance;
    EdgeChoice edges;                             // of the scene and settings, as the next
    std::unique_ptr<PathReplacement> replacement; // of an integrator for comparison; null: path tracing
    bool replacement_is_ready = false;
    Vec3d replacement_origin{0, 0, 0};   // that its positions are relative to
    int max_bounces = unlimited_bounces; // as asked for; those of `settings` are fewer for an integrator for comparison
    LearnedSampling learned;
    std::optional<SmallHighlights> highlights;         // of the scene and settings; empty: not searched for
    bool film_is_stale = true, film_is_uneven = false; // uneven: rendering stopped in the middle of a sample
    bool first_is_rough = false;                       // the film holds the first sample of each pixel without smooth edges
    bool first_is_trained = false;                     // and has only that sample, with a field of before an edit
    bool splats = false;                               // a film at full size holds those of light paths, as their pilot decided
    bool early_splats = false;                         // the film holds those of LightPathChoice::early()
    int64_t first_pass_tiles = 0;                      // of its first pass, if the other tiles are still to be traced
    bool first_as_others = false;                      // the first sample is rendered as learned sampling decides for the others
    int divider = 1;
    FirstHitPlanesPtr first_hits; // of the scene; null: none
    const Kernel* kernel = nullptr;
    std::string kernel_name;
    double seconds_setup = 0;
    // Computed on request: it reads every triangle, too slow during a drag.
    std::optional<CompiledInfo> info;
    std::shared_ptr<const FeatureReport> feature_report; // null: must be computed
    int64_t samples = 0;
    int64_t loaded_first = 0; // first sample of a film that was loaded, else 0
    RayCounts rays;
    StageSeconds stages; // since the film was cleared
    std::vector<PathCounts> path_counts;
    int64_t truncated = 0;

    explicit State(const RendererOptions& o)
        : options(o), workers(o.threads, o.low_priority), scratch(workers.threads()), replays(workers.threads()),
          catching(workers.threads()), at_edges(workers.threads()), replacement(make_integrator(o.integrator)) {}

    int film_width() const { return std::max(1, settings.width / divider); }
    int film_height() const { return std::max(1, settings.height / divider); }
    // Without its seed. `tables` of the scene.
    KernelContext context_for(const SceneTables& tables, int width, int height) const;
    // A sample of this index follows the decisions of the pilots for the sample of the returned index; 0: none.
    int64_t decided_as(int64_t sample) const { return divider > 1 ? 0 : first_as_others ? std::max<int64_t>(sample, 1) : sample; }
    int reuse_group_size(int64_t sample) const {
        if (learned.kept_seeds()) return 1;
        return divider > 1 ? learned.reuse().first_group_size() : learned.reuse_group_size(decided_as(sample));
    }
    // True if the first sample uses the field or the seeds that an edit left over: the pilots have not run. Coarse images do not use the
    // field: they have so few samples that the caustic, which most of them miss without, would be noise.
    bool uses_kept() const { return learned.kept_seeds() || (divider == 1 && learned.kept_field()); }
    SceneTables tables_for(int64_t sample) const {
        return uses_kept() ? learned.kept_tables(scene.tables()) : learned.tables(scene.tables(), decided_as(sample));
    }
    // The kernel for samples of these tables.
    const Kernel& kernel_for(const SceneTables& tables) const {
        return tables.emission.empty() && tables.manifolds.empty() ? *kernel
                                                                   : kernel_like(*kernel, kernel->features.with(Feature::light_paths));
    }

    static std::string name_of(const Kernel& k) { return std::string(k.isa) + "/" + std::string(k.name); }

    FilmSize full_film() const {
        return {settings.width,    settings.height,
                options.planes,    transparent(),
                settings.adaptive, int(mixing.gains.size()),
                catches(),         early_splats || (splats && divider == 1) || (replacement && replacement->splats())};
    }
    // If the scene differs from the film only in the light mix, applies the mix and returns true.
    bool apply_mix(const Scene& whole, const RenderSettings& now) {
        if (!groups || !same_image(settings, now)) return false;
        std::optional<Mixing> mix = compared_mixing(*groups, whole);
        if (!mix) return false;
        set_mix(*std::move(mix));
        settings = now;
        return true;
    }
    void set_mix(Mixing mix) {
        mixing = std::move(mix);
        film.set_gains(mixing.gains);
    }
    enum class Outdated { nothing, view, film };
    // Updates the compiled scene. View: the film is outdated, and nothing but the view has changed.
    Outdated compile(const Scene& whole, const RenderSettings& now, LightGroupsPtr groups_of_scene);
    // Discards the samples; their setup began at `begun`.
    void begin_film(Clock::time_point begun, Outdated outdated);
    // For a scene, settings or planes that differ from those of `learned` as the effect says.
    void begin_learning(const FieldEffect& effect, bool same_photons);

    bool hides_environment() const {
        const Environment& e = expanded->environment;
        return e.kind != Environment::Kind::none && !e.visible_to_camera;
    }
    bool catches() const { return !scene.catchers().empty(); }
    // A caught shadow needs a background: without an environment the image is for compositing.
    bool transparent() const {
        return expanded && (hides_environment() || (catches() && expanded->environment.kind == Environment::Kind::none));
    }

    void clear() {
        film_is_stale = true;
        film_is_uneven = false;
        replacement_is_ready = replacement_is_ready && options.integrator.baked;
        first_is_rough = first_as_others = first_is_trained = false;
        first_pass_tiles = 0;
        feature_report.reset();
        samples = loaded_first = 0;
        rays = {};
        stages = {};
        path_counts.clear();
        truncated = 0;
    }
    // full_film() at the film's resolution.
    FilmSize divided_film() const {
        FilmSize size = full_film();
        size.width = film_width();
        size.height = film_height();
        return size;
    }
    // Clearing a full-size film takes as long as rendering a coarse image, so it is delayed until the next draw or read: edits
    // often change the divider afterwards.
    void clear_stale_film() {
        if (!film_is_stale) return;
        film.reset(divided_film(), settings.clamp);
        film.set_gains(mixing.gains);
        sample_allocation.reset(film_width(), film_height());
        if (options.allocation && divider == 1) sample_allocation.restore(*options.allocation);
        film_is_stale = false;
    }
    CausticFinders caustic_finders() const {
        if (learned.kept_seeds()) return CausticFinders::manifolds;
        if (early_splats) return CausticFinders::light_paths;
        if (divider > 1 || !splats) return divider == 1 && learned.uses_manifolds() ? CausticFinders::manifolds : CausticFinders::none;
        return learned.uses_manifolds() ? CausticFinders::light_paths_and_manifolds : CausticFinders::light_paths;
    }
    // Pixels in the groups of path reuse in which samples of the film are correlated; 1: none.
    int film_group_size() const {
        return splats && !learned.light_paths().alone() ? 1 : blush::reuse_group_size(settings, learned.reuse().pilot());
    }
    // For a film without samples, once the pilots have decided.
    void begin_splats() {
        if (splats == learned.light_paths().pays()) return;
        splats = !splats;
        film_is_stale = true;
        clear_stale_film();
    }
    // The same for coarse images, and for a first sample before the pilots.
    void begin_early_splats(bool allowed) {
        const bool now = allowed && learned.early_light_paths(scene.tables(), 1);
        if (std::exchange(early_splats, now) != now) film_is_stale = true;
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
    bool render_run(TileJob rectangle, const Run& run, int max_samples, unsigned worker, const Wanted& wanted);
    bool for_each_tile(const TileShape& shape, const Wanted& wanted, const TileTask& task);
    bool render_uniformly(int64_t first, int64_t count, const Wanted& wanted);
    bool render_by_plan(int64_t first, int64_t count, const Wanted& wanted);
    bool refine_first_sample(const Wanted& wanted);
    bool complete_first_sample(const Wanted& wanted);
    bool renew_first_sample(const Wanted& wanted);
    bool render_first_again(const Wanted& wanted);
    bool add_first_pass(const Wanted& wanted);
    // Runs the pilots that samples of an index below `samples` need: those of learned sampling, those of smooth edges and highlights, all.
    bool learn(int64_t samples, const Wanted& wanted);
    bool decide_edges(const Wanted& wanted);
    bool decide(int64_t samples, const Wanted& wanted);
    // Settings of the kernels: an integrator for comparison takes direct light or emission alone from them.
    RenderSettings kernel_settings_for(const RenderSettings& asked) const;
    // With all bounces.
    KernelContext replacement_context() const;
    bool prepare_replacement(const Wanted& wanted);
    bool prepare_replacement_for(int64_t sample, const Wanted& wanted);
    bool add_replacement_passes(int64_t first, int64_t count, const Wanted& wanted);
    void add_replacement(const TileJob& job, TileScratch& tile, unsigned worker);
    bool needs_highlights() const;
    bool find_edges_and_highlights(const KernelContext& context, const Wanted& wanted);
    // Of the light paths of a pass, tiles of tile_capacity.
    struct TileRange {
        int64_t begin, end;
    };
    int64_t light_path_tiles() const;
    // Of the light paths of a pass, that in its first tiles.
    double share_of_pass(int64_t tiles) const {
        return tiles < light_path_tiles() ? double(tiles * tile_capacity) / double(learned.light_paths().paths()) : 1;
    }
    bool trace_light_paths(int64_t first, int64_t count, const Wanted& wanted);
    bool begin_first_pass(const Wanted& wanted);
    bool add_to_first_pass(const Wanted& wanted);
    bool complete_first_pass(const Wanted& wanted);
    bool trace_early_light_paths(int64_t first, int64_t count, const Wanted& wanted);
    bool trace_tiles_of_passes(const LightPathPass& each, int64_t first, int64_t count, const TileRange& range, const Wanted& wanted);
    void collect_counts(const TickRate& rate);
    bool correlates_pixels() const { return replacement && replacement->correlates_pixels(); }

    // True if the pilots of learned sampling have run before the first sample, and it would be rendered again with the second.
    bool begins_decided(int64_t first) const { return first == 0 && samples == 0 && !learned.needs_pilot(2) && learned.renews_first(); }
    // True if the film has only such a first sample, which gets smooth edges and the rest of its light paths with the second.
    bool first_is_incomplete() const { return first_as_others && first_is_rough && samples == 1; }
    // True if the first sample of each pixel is rendered in another way than the next.
    bool first_differs() const {
        return divider == 1 && (edges.pixels(1) || (!first_as_others && (learned.pays() || reuse_group_size(0) != reuse_group_size(1))));
    }
    EdgeScratch& edge_scratch_of(unsigned worker) {
        if (!at_edges[worker]) at_edges[worker] = std::make_unique<EdgeScratch>();
        return *at_edges[worker];
    }
    TileScratch& scratch_of(unsigned worker) {
        if (!scratch[worker]) scratch[worker] = std::make_unique<TileScratch>();
        fit_columns(*scratch[worker], film);
        return *scratch[worker];
    }
};

} // namespace blush
