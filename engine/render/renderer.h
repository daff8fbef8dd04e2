// Renders scenes into frames: everything the render thread does, without the thread. Used by the session, the headless commands,
// the tests and the benchmarks.
#pragma once

#include "core/result.h"
#include "render/comparison/comparison_integrator.h"
#include "render/compile/compiled_info.h"
#include "render/error/reuse_covariance.h"
#include "render/film/film_size.h"
#include "render/film/sample_allocation.h"
#include "render/first_hit_planes.h"
#include "render/frame.h"
#include "render/light_mix/light_groups.h"
#include "render/pilots/caustic_options.h"
#include "scene/render_settings.h"
#include "scene/scene.h"

#include <cstdint>
#include <experimental/propagate_const>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace blush {

struct RendererOptions {
    unsigned threads = 0; // 0: one per core
    bool low_priority = false;
    PlaneSet planes = {};
    bool filter_textures = true; // false: to measure the effect of filtering
    CausticOptions caustics = {};
    // The first sample uses the field of path guiding that an edit left over, until the pilots have run (kept_field.h).
    // It then depends on earlier edits; what follows does not, nor what save_film() gives.
    bool begins_trained = false;
    // The film will be merged with others of the same image: a lone first sample is rendered as if others followed it.
    bool is_part = false;
    // Of a part: adaptive sampling by these shares, which fit the film, instead of those of a pilot.
    std::optional<SampleAllocation::Shares> allocation = {};
    // Not path tracing, for comparison: the film's beauty alone is that of this integrator, other planes hold its direct light.
    ComparisonIntegrator integrator = {};
};

// World-space position of a light meter, lit from the side of its normal.
struct MeterPlace {
    Vec3d position{0, 0, 0}, normal{0, 1, 0};
    double clearance = 0; // offset in metres from the surface, against self-shadowing
    bool operator==(const MeterPlace&) const = default;
};

struct FilmState; // film_state.h

class Renderer {
public:
    explicit Renderer(const RendererOptions& options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Applies a scene: diffs it against the last one, plans, and updates what changed. Clears the film if it is outdated; returns
    // whether it did. The result is bit-identical to a fresh Renderer given the same scene. With a light mix, changes of emission
    // alone keep the film, whose planes hold the emission at the last clear; all results are remixed.
    bool update(const Scene& scene, const RenderSettings& settings);
    // The same for callers that know that a new image begins (session/submission.h): clears the film in any case. `groups`: light
    // groups of the scene; null: no light mix.
    void begin_image(const Scene& scene, const RenderSettings& settings, LightGroupsPtr groups);
    // Shows the samples with another mix, made for the groups that begin_image() was given.
    void set_mix(const Mixing& mixing);
    // Weights light selection by the current mix, from the next sample on.
    void select_lights_by_mix();

    // Clears the film unless it has all of them; frees planes that are no longer used.
    void set_planes(const PlaneSet& planes);

    // Film size: full size / divider, at least 1x1. Changing the divider clears the film.
    void set_divider(int divider);
    int divider() const;

    // Adds samples [first, first + count) of every pixel, tile by tile, while `wanted` (called often, from many threads) returns
    // true. False if stopped: pixels then hold different numbers of samples, which can be shown but not continued. Results do not
    // depend on threads, tiles or on how a range of samples is split into calls. Adaptive: `count` more samples per pixel on
    // average (sample_allocation.h), whatever `first`, except for a part. Where the pilots gain much, the first sample of a film is
    // rendered again with the second (LearnedSampling::renews_first), or at once as they decided if they have run before it; alone, it is
    // then incomplete, as after decide_first_sample().
    bool render(int64_t first, int64_t count, const std::function<bool()>& wanted = {});
    // Makes a lone first sample independent of edits: renders it again if it used a field of before an edit, and completes one after
    // decide_first_sample(). False if stopped.
    bool settle_first_sample(const std::function<bool()>& wanted = {});
    void clear();
    // True if first samples and coarse images begin with the seeds of manifold sampling of before an edit.
    bool begins_with_seeds() const;
    // Runs the pilots that samples of an index below `samples` need and that have not run: of learned visibility, learned portals, path
    // guiding, light paths, manifold sampling, path reuse and Russian roulette (learned_sampling.h), and smooth edges (edge_choice.h).
    // Otherwise render() does so before the first sample at full resolution that needs them. False if stopped.
    bool decide(const std::function<bool()>& wanted = {}, int64_t samples = std::numeric_limits<int64_t>::max());
    // Runs those of learned sampling alone, so that a first sample that would be rendered again with the second is rendered as they
    // decide at once. To be shown soon, it does not wait for the pilot of smooth edges, and has at most as many light paths as camera
    // paths; it gets smooth edges and the other light paths with the second sample. False if stopped.
    bool decide_first_sample(const std::function<bool()>& wanted = {});
    // True if the film has such a first sample and not all of its light paths. More of them may be added at once, to be shown between: as
    // many as camera paths, or those that are left. False if stopped; then there are as many as before.
    bool lacks_light_paths() const;
    bool add_light_paths(const std::function<bool()>& wanted = {});

    // First hits in the last applied scene at full size, which joint upsampling of coarse images needs (joint_upsampling.h). Kept while
    // edits change only light; null: none. Traced through pixel centres.
    FirstHitPlanesPtr first_hits() const;
    FirstHitPlanesPtr trace_first_hits();
    // Keeps these instead, of a film of the last applied scene.
    void keep_first_hits(FirstHitPlanesPtr planes);
    // False if the camera has an aperture, or the image is transparent: then a first hit does not say what a pixel shows.
    bool has_sharp_first_hits() const;
    // Of the last applied scene.
    WorldCamera world_camera() const;

    // The film so far, divided by its sample counts. The second overload reuses the memory of an old frame and does not estimate
    // the error, which costs as much as some hundredths of a sample.
    Frame resolve();
    void resolve(Frame& frame);
    // Estimates the error of the film from its two halves.
    ErrorEstimate estimate_error();
    // Standard error of the mean of each pixel from the two half buffers, RGB; empty before both hold samples.
    std::vector<Vec3> resolve_error();
    // Error correlation between pixels by path reuse, or without it by the sampler.
    ReuseCovariance reuse_covariance();

    // Saves the film exactly: another renderer of the same scene and settings continues as if it
    // had rendered it. `first` is the index of its first sample. Errors: nothing is rendered,
    // rendering was stopped in the middle of a sample, the film is not at full resolution, its first sample is not settled.
    Result<FilmState> save_film(int64_t first) const;
    // Replaces the film, at full size; continue with sample first_sample + samples. Errors: it does not fit the settings or lacks
    // a plane; the film is then empty.
    Result<void> load_film(const FilmState& state);

    // Irradiance at a light meter in the last applied scene: one of many
    // independent estimates (irradiance.h), RGB in lux. Does not touch the film.
    Vec3d irradiance(const MeterPlace& place, uint32_t replicate, int samples);
    // True if anything in the last applied scene emits light.
    bool has_light() const;

    // Of the last applied scene. Not for use during edits: the first call reads every triangle.
    const CompiledInfo& info();
    // Feature report at full resolution. Cheap; never null.
    std::shared_ptr<const FeatureReport> feature_report();

private:
    struct State;
    std::experimental::propagate_const<std::unique_ptr<State>> state_; // const functions change nothing
};

// Prints every vertex of one sample: throughput, pdfs, MIS weights, roulette, contribution (`blush render --pixel`).
std::string trace_sample(const Scene& scene, const RenderSettings& settings, int x, int y, int64_t sample);

// Names accepted in BLUSH_ISA and used for kernels: "scalar", "v2", "v3", "v4"; those this machine can run.
std::vector<std::string> available_isas();

} // namespace blush
