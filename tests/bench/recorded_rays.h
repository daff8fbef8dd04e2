// Records the rays of a render and traces them again without shading: the speed of Embree alone.
#pragma once

#include "core/parallel.h"
#include "render/kernels/kernel.h"

#include <array>
#include <cstdint>
#include <vector>

namespace blush::bench {

enum class RayKind { camera, bounce, shadow };
constexpr std::array<RayKind, 3> ray_kinds{RayKind::camera, RayKind::bounce, RayKind::shadow};

// The rays that one stage of one tile passes to Embree. Arrays are padded to whole packets.
struct RayBatch {
    int count = 0;
    bool coherent = false;
    std::vector<float> ox, oy, oz, dx, dy, dz;
    std::vector<float> far_distance; // shadow rays only
    bool blends = false;             // of a scene with blended surfaces
    std::vector<uint32_t> random;    // only of such a scene
};

// By kind.
using RecordedRays = std::array<std::vector<RayBatch>, ray_kinds.size()>;

// Renders the tiles, path by path, and records every ray. In-order compaction makes queues independent of the lane type: these
// are the packets that the wide kernels trace.
RecordedRays record_rays(const KernelContext& context, const std::vector<TileJob>& tiles, const Workers& workers);

int64_t count_rays(const std::vector<RayBatch>& batches);
// Traces all rays of one kind through the same calls as the renderer, including packet assembly, and ignores the hits.
void replay(const Accel& accel, const RecordedRays& rays, RayKind kind, const Workers& workers);

} // namespace blush::bench
