// A kernel renders one tile of paths; there is one kernel for each instruction set and feature set.
#pragma once

#include "core/vec.h"
#include "render/bvh/accel.h"
#include "render/compile/scene_tables.h"
#include "render/film/path_counts.h"
#include "render/film/stage_times.h"
#include "render/integrator/estimator_settings.h"
#include "render/kernels/bounce_columns.h"
#include "render/kernels/chain_columns.h"
#include "render/kernels/column.h"
#include "render/kernels/group_columns.h"
#include "render/kernels/light_path_columns.h"
#include "render/kernels/light_vertex_columns.h"
#include "render/kernels/manifold_columns.h"
#include "render/kernels/reuse_columns.h"
#include "render/kernels/shadow_queue.h"
#include "render/kernels/strategy_columns.h"
#include "render/lights/continuation_trial.h"
#include "render/lights/escape_trial.h"
#include "render/lights/guiding_trial.h"
#include "render/lights/shadow_trial.h"
#include "shading/features.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// A rectangle of pixels with `samples` sample indices each; width * height * samples <= tile_capacity.
struct TileJob {
    int x = 0, y = 0, width = 0, height = 0;
    int64_t first_sample = 0;
    int samples = 1;
    int stride = 1; // step of the sample index: 2 stays within one half of the film
    int64_t sample(int s) const { return first_sample + int64_t(s) * stride; }
    int paths() const { return width * height * samples; }
};

struct PathQueue {
    int size = 0;
    Column<float> ox, oy, oz, dx, dy, dz, beta_r, beta_g, beta_b, pdf;
    Column<float> nx, ny, nz;                  // with a light tree
    Column<float> cone;                        // with textures
    Column<float> light_ratio, emission_ratio; // with light paths, as the next
    Column<int32_t> chain;
    Column<uint32_t> key, index;
    Column<int32_t> slot;
    Column<int32_t> part;      // that the ray left, -1: the camera; written only if lights may be linked
    Column<int32_t> dispersed; // written only with Feature::dispersion
};
struct HitColumns {
    Column<float> t, u, v;
    Column<int32_t> geometry, instance, triangle;
};
struct FirstHitColumns {
    Column<float> albedo_r, albedo_g, albedo_b, normal_x, normal_y, normal_z, depth;
    Column<int32_t> object, material; // material: index into the material table, -1 on a miss
};

// Statistics of path lengths and Russian roulette.
struct RouletteColumns {
    Column<float> length;                   // vertices of each path, including the one where it escapes
    Column<float> num_rr_applied;           // number of roulette decisions,
    Column<float> survival;                 // and the sum of their survival probabilities
    PathCounts counts[max_counted_bounces]; // accumulated
};

// For splitting (path_splitting.h) and delta chains (delta_chains.h).
constexpr int most_copies = 8; // of a sample that are traced at once; a tile whose paths split has room for so many of each
struct SplittingColumns {
    Column<int32_t> alive;  // by slot: paths of the sample
    Column<int32_t> copies; // by path of the queue
};

// For passing panes (thin_transmission.h).
struct PaneColumns {
    Column<int32_t> passed; // by path of the queue: number of panes passed
    HitColumns hits;        // of the rays behind them
};

// A worker's memory for a tile, and the tile's results. Results are by slot: slot = pixel * samples + sample, pixels row by row.
struct TileScratch {
    PathQueue paths[2];
    HitColumns hits;
    ShadowQueue shadows;
    Column<uint32_t> random;
    Column<uint8_t> blocked;

    Column<double> r, g, b;                             // radiance; single precision would lose a long path's last terms
    std::unique_ptr<FirstHitColumns> first;             // null: not needed
    std::unique_ptr<BounceColumns> bounces;             // null: not needed
    std::unique_ptr<GroupColumns> groups;               // null: no light mix
    std::unique_ptr<StrategyColumns> strategies;        // null: not needed
    std::unique_ptr<ReuseColumns> reuse;                // allocated by the first kernel with path reuse
    std::unique_ptr<RouletteColumns> roulette;          // null: not needed
    std::unique_ptr<PaneColumns> panes;                 // allocated by the first kernel with panes
    std::unique_ptr<Column<float>> background_share;    // by path of the queue; allocated by the first kernel that needs it
    std::unique_ptr<std::vector<ShadowTrial>> trials;   // of the tile's shadow rays, accumulated; null: not recorded
    std::unique_ptr<EscapeTrials> escapes;              // null: not recorded
    std::unique_ptr<GuidingTrials> guiding;             // null: not recorded; not with path reuse
    std::unique_ptr<ContinuationTrials> continuations;  // null: not recorded; not with path reuse
    std::unique_ptr<Column<float>> importance;          // of the slot's pixel (shading/learned_adjoint.h); null until a kernel needs it
    std::unique_ptr<ContinuationTrials> arrivals;       // the same, of paths that arrive at a surface
    std::unique_ptr<SplittingColumns> splitting;        // allocated by the first kernel that splits paths
    std::unique_ptr<PhotonTrials> photons;              // null: paths begin at the camera; else one for each path of the tile
    std::unique_ptr<LightPathColumns> light_paths;      // null: no light paths
    std::unique_ptr<ManifoldColumns> manifolds;         // allocated by the first kernel with manifold sampling
    std::unique_ptr<LightVertexColumns> light_vertices; // allocated by the first kernel with light vertices
    std::unique_ptr<ChainColumns> chains;               // allocated by the first kernel that follows delta chains
    int64_t camera_rays = 0, bounce_rays = 0, shadow_rays = 0, truncated_paths = 0; // accumulated
    StageTicks stages;                                                              // accumulated
};

struct KernelContext {
    const SceneTables* scene = nullptr;
    const Accel* accel = nullptr;
    EstimatorSettings settings;
    uint32_t seed = 0;
};

using TileFunction = void (*)(const KernelContext&, const TileJob&, TileScratch&);
// Traces the paths of TileScratch::light_paths, and leaves their splats there.
using LightPathFunction = void (*)(const KernelContext&, TileScratch&);
// emit_light_paths() of render/integrator/light_path_sampling.h.
using EmitFunction = void (*)(const SceneTables&, const EmissionTables&, const uint32_t* keys, const uint32_t* indices, int count,
                              std::vector<EmittedPath>&);

struct Kernel {
    std::string_view isa;  // "scalar", "v2", "v3", "v4": x86-64 micro-architecture levels
    std::string_view name; // of the feature set: "lambert", ...
    Features features;
    TileFunction render = nullptr;
    TileFunction trace_chains = nullptr;           // the emission at the end of delta chains; or ChainColumns::sights
    LightPathFunction trace_light_paths = nullptr; // null without Feature::light_paths,
    EmitFunction emit_light_paths = nullptr;       // so is this
};

std::span<const Kernel> kernels_scalar();
std::span<const Kernel> kernels_v2();
std::span<const Kernel> kernels_v3();
std::span<const Kernel> kernels_v4();

// Instruction sets that this processor supports, widest last; "scalar" first.
std::span<const std::string_view> runnable_isas();
// All kernels of one instruction set, smallest feature set first; empty for an unknown name.
std::span<const Kernel> kernels_of(std::string_view isa);
// The kernel of another feature set for the same instruction set: the smallest with all `needed` features.
const Kernel& kernel_like(const Kernel& kernel, Features needed);
// The smallest kernel with all `needed` features, for $BLUSH_ISA if set and supported, else for the widest instruction set.
const Kernel& choose_kernel(Features needed);

} // namespace blush
