// Scene in, pictures out: everything the render thread does, without the thread. The session drives one of these;
// so do the headless commands, the tests and the bench.
#pragma once

#include "core/result.h"
#include "render/frame.h"
#include "render/shared_errors.h"
#include "scene/render_settings.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace blush {

// Bounce planes: 24 bytes per pixel each.
constexpr int most_bounce_planes = 32, usual_bounce_planes = 8;

// Film planes beside the beauty. Only what somebody reads is allocated.
struct PlaneSet {
    bool albedo = false, normal = false, depth = false, ids = false;
    int bounces = 0; // radiance by the number of scatterings: 0, 1, ..., bounces - 1 and all further ones; 0: none, else 2 .. most_bounce_planes
    bool roulette = false; // path length and survival probability of each pixel, paths by bounce
    bool error = false;    // standard error of each pixel's mean: worked out of the two halves, it takes no plane of its own
    bool operator==(const PlaneSet&) const = default;
    // Has all that `other` has.
    bool covers(const PlaneSet& other) const {
        return albedo >= other.albedo && normal >= other.normal && depth >= other.depth && ids >= other.ids && roulette >= other.roulette &&
               (bounces == other.bounces || other.bounces == 0);
    }
};

struct RendererOptions {
    unsigned threads = 0; // 0: one per core
    bool low_priority = false;
    PlaneSet planes = {};
    bool filter_textures = true; // false: for measuring what filtering does
};

// Of a light meter, in the world: light falls on it from the side of its normal.
struct MeterPlace {
    Vec3d position{0, 0, 0}, normal{0, 1, 0};
    double clearance = 0; // metres off the surface, so that it does not shadow itself
    bool operator==(const MeterPlace&) const = default;
};

struct CompiledInfo {
    int64_t meshes = 0, instances = 0, materials = 0, textures = 0;
    int64_t triangles = 0; // as seen by rays: instances counted each time
    int64_t emissive_triangles = 0, point_lights = 0, suns = 0;
    bool environment = false;
    std::string kernel;               // "v4/plain"
    Ledger features;                  // of the kernel and of everything else that is made only where it is needed
    double memory_mb = 0;             // tables, textures and Embree's structures
    double seconds_setup = 0;         // the last update: from scene to first ray
    std::vector<Diagnostic> warnings; // degenerate triangles dropped, non-finite transforms, ...
};

struct FilmState; // film_state.h

class Renderer {
public:
    explicit Renderer(const RendererOptions& options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Takes up a scene: diff against the last one, plan, update what changed. Clears the film if what is in it no longer
    // answers; returns whether it did. The result renders bit-identically to a fresh Renderer given the same scene.
    // While lights are mixed, a change of their light alone keeps the film, whose planes hold what was there when it was last cleared,
    // and all that is read from it is mixed anew.
    bool update(const Scene& scene, const RenderSettings& settings);
    // Aims at lights by what they are worth in the mix by now, from the next sample on.
    void aim_at_mix();

    // Clears the film unless it has all of them; what nobody asks for any more is freed.
    void set_planes(const PlaneSet& planes);

    // Size of the film: full size / divider, at least 1x1. Changing the divider clears the film.
    void set_divider(int divider);
    int divider() const;

    // Adds samples [first, first + count) of every pixel, tile by tile, while `wanted` (called often, from many threads)
    // says true. False if it was stopped: pixels then hold different numbers of samples, which is still a picture but not one to go on
    // from. Results do not depend on threads, tiles or on how a range of samples is split into calls. Adaptive: `count` more samples per
    // pixel on average (sample_plan.h), whatever `first`.
    bool render(int64_t first, int64_t count, const std::function<bool()>& wanted = {});
    void clear();

    // The film so far, divided by its sample counts. The second reuses the memory of an old frame and does not estimate the error, which
    // costs as much as some hundredths of a sample.
    Frame resolve() const;
    void resolve(Frame& frame) const;
    // Of the film so far, from its two halves.
    ErrorEstimate estimate_error() const;
    // Standard error of the mean of each pixel from the two half buffers, RGB; empty before both hold samples.
    std::vector<Vec3> resolve_error() const;
    // What these errors have in common under path reuse; pixels err independently without.
    SharedErrors shared_errors() const;

    // The film as a value, exactly, from which another renderer of the same scene and settings goes on as if it had rendered it. `first` is
    // the index of its first sample. Errors: nothing is rendered, rendering was stopped half-way, the film is not of full size.
    Result<FilmState> save_film(int64_t first) const;
    // Replaces the film, at full size; go on with sample first_sample + samples. Errors: it does not fit the settings or lacks a plane; the
    // film is then empty.
    Result<void> load_film(const FilmState& state);

    // What a light meter at a place of the scene last taken up reads: one of many independent estimates (irradiance.h), RGB in lux. The
    // film is not touched.
    Vec3d irradiance(const MeterPlace& place, uint32_t replicate, int samples) const;
    // Whether anything in the scene last taken up gives light.
    bool has_light() const;

    // Of the scene last taken up. Not for the path of an edit: looks at every triangle the first time it is asked.
    const CompiledInfo& info() const;
    // What was made for it and what was left out, at full resolution. Cheap; never null.
    std::shared_ptr<const Ledger> ledger() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Prints every vertex of one sample: throughput, pdfs, MIS weights, roulette, contribution (`blush render --pixel`).
std::string trace_sample(const Scene& scene, const RenderSettings& settings, int x, int y, int64_t sample);

// Names accepted in BLUSH_ISA and used for kernels: "scalar", "v2", "v3", "v4"; those this machine can run.
std::vector<std::string> available_isas();

} // namespace blush
