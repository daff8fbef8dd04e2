// A kernel renders one tile of paths; there is one for each instruction set and set of features.
#pragma once

#include "core/vec.h"
#include "render/accel.h"
#include "render/estimator_settings.h"
#include "render/kernels/column.h"
#include "render/kernels/group_columns.h"
#include "render/kernels/reuse_columns.h"
#include "render/path_counts.h"
#include "render/scene_tables.h"
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
    int stride = 1; // from one sample index to the next: 2 stays within one half of the film
    int64_t sample(int s) const { return first_sample + int64_t(s) * stride; }
    int paths() const { return width * height * samples; }
};

struct PathQueue {
    int size = 0;
    Column<float> ox, oy, oz, dx, dy, dz, beta_r, beta_g, beta_b, pdf;
    Column<float> nx, ny, nz; // with a light tree
    Column<float> cone;       // with textures
    Column<uint32_t> key, index;
    Column<int32_t> slot;
    Column<int32_t> part; // that the ray left, -1: the camera; written only if lights may be linked
    Column<int32_t> dispersed; // written only with Feature::dispersion
};
struct HitColumns {
    Column<float> t, u, v;
    Column<int32_t> geometry, instance, triangle;
};
struct ShadowQueue {
    int size = 0;
    Column<float> ox, oy, oz, dx, dy, dz, distance, r, g, b;
    Column<int32_t> slot;
    Column<uint32_t> random; // for stochastic opacity; written only if something is not opaque
    Column<int32_t> group;   // of the light; written only if somebody mixes
    Column<uint32_t> mask;   // what the ray meets; written only if lights are linked
};
struct FirstHitColumns {
    Column<float> albedo_r, albedo_g, albedo_b, normal_x, normal_y, normal_z, depth;
    Column<int32_t> object, material; // material: index into the material table, -1 on a miss
};

// The radiance of each path as it grows: after[k] holds what arrived by at most k scatterings. Never longer than the film asked for.
struct BounceColumns {
    explicit BounceColumns(int count) : after(size_t(count)) {}
    std::vector<RadianceColumns> after;
    int recorded = 0; // of them; where all paths ended earlier, the others would hold their final radiance
};

// How long paths get and what roulette does to them.
struct RouletteColumns {
    Column<float> length;   // vertices of each path, the one where it leaves the scene among them
    Column<float> asked;    // how often roulette was asked about it,
    Column<float> survival; // and the sum of the probabilities that it gave
    PathCounts counts[most_counted_bounces]; // counted up
};

// Where panes are passed (thin_transmission.h).
struct PaneColumns {
    Column<int32_t> passed; // by path of the queue: how many panes its ray has passed
    HitColumns hits;        // of the rays behind them
};

// A worker's memory for tiles, and what a tile leaves in it. Results are by slot: slot = pixel * samples + sample, pixels by rows.
struct TileScratch {
    PathQueue paths[2];
    HitColumns hits;
    ShadowQueue shadows;
    Column<uint32_t> random;
    Column<uint8_t> blocked;

    Column<double> r, g, b;                 // radiance; in single precision a long path's last terms would be lost in its sum
    std::unique_ptr<FirstHitColumns> first; // null: nobody reads it
    std::unique_ptr<BounceColumns> bounces; // null: nobody reads it
    std::unique_ptr<GroupColumns> groups;   // null: nobody mixes
    std::unique_ptr<ReuseColumns> reuse;       // made by the first kernel that is told to
    std::unique_ptr<RouletteColumns> roulette; // null: nobody reads it
    std::unique_ptr<PaneColumns> panes;        // made by the first kernel whose scene has some
    int64_t camera_rays = 0, bounce_rays = 0, shadow_rays = 0, truncated_paths = 0; // counted up
};

struct KernelContext {
    const SceneTables* scene = nullptr;
    const Accel* accel = nullptr;
    EstimatorSettings settings;
    uint32_t seed = 0;
};

using TileFunction = void (*)(const KernelContext&, const TileJob&, TileScratch&);

struct Kernel {
    std::string_view isa;  // "scalar", "v2", "v3", "v4": x86-64 micro-architecture levels
    std::string_view name; // of the set of features: "lambert", ...
    Features features;
    TileFunction render = nullptr;
};

std::span<const Kernel> kernels_scalar();
std::span<const Kernel> kernels_v2();
std::span<const Kernel> kernels_v3();
std::span<const Kernel> kernels_v4();

// Instruction sets this processor can run, widest last; "scalar" first.
std::span<const std::string_view> runnable_isas();
// All kernels of one instruction set, smallest feature set first; empty for an unknown name.
std::span<const Kernel> kernels_of(std::string_view isa);
// The smallest kernel that has all `needed` features, for $BLUSH_ISA if that is set and runnable, else the widest instruction set.
const Kernel& choose_kernel(Features needed);

} // namespace blush
