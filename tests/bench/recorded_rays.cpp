#include "tests/bench/recorded_rays.h"

#include "render/integrator/wavefront.h"

#include <memory>

namespace blush::bench {
namespace {

constexpr int packet = 16;

template <class T> std::vector<T> copied(const T* column, int count) {
    std::vector<T> copy(column, column + count);
    copy.resize(size_t((count + packet - 1) / packet * packet));
    return copy;
}

// Of either queue.
template <class Queue> RayBatch batch_of(const Queue& q, const uint32_t* random, const KernelContext& context, int bounce) {
    RayBatch batch;
    batch.count = q.size;
    batch.coherent = bounce == 0;
    batch.ox = copied<float>(q.ox, q.size);
    batch.oy = copied<float>(q.oy, q.size);
    batch.oz = copied<float>(q.oz, q.size);
    batch.dx = copied<float>(q.dx, q.size);
    batch.dy = copied<float>(q.dy, q.size);
    batch.dz = copied<float>(q.dz, q.size);
    batch.blends = context.scene->blends;
    if (batch.blends) batch.random = copied<uint32_t>(random, q.size);
    return batch;
}

std::vector<RayBatch>& of_kind(RecordedRays& rays, RayKind kind) { return rays[size_t(kind)]; }

RecordedRays record_tile(const KernelContext& context, const TileJob& job, TileScratch& scratch) {
    RecordedRays rays;
    generate_paths<all_features, float>(context, job, scratch);
    PathQueue* now = &scratch.paths[0];
    PathQueue* next = &scratch.paths[1];
    for (int bounce = 0; now->size > 0 && bounce <= max_path_length; ++bounce) {
        trace_paths<all_features, float>(context, scratch, *now, *next, bounce);
        of_kind(rays, bounce == 0 ? RayKind::camera : RayKind::bounce).push_back(batch_of(*now, scratch.random, context, bounce));
        shade_paths<all_features, float>(context, scratch, *now, *next, bounce);
        if (const ShadowQueue& shadows = scratch.shadows; shadows.size > 0) {
            RayBatch batch = batch_of(shadows, shadows.random, context, bounce);
            batch.far_distance = copied<float>(shadows.distance, shadows.size);
            of_kind(rays, RayKind::shadow).push_back(std::move(batch));
            connect_paths<all_features, float>(context, scratch, bounce);
        }
        std::swap(now, next);
    }
    return rays;
}

RayArrays arrays_of(const RayBatch& b) {
    const auto or_null = [](const auto& column) { return column.empty() ? nullptr : column.data(); };
    return {b.ox.data(), b.oy.data(), b.oz.data(), b.dx.data(), b.dy.data(), b.dz.data(), or_null(b.far_distance), or_null(b.random)};
}

} // namespace

RecordedRays record_rays(const KernelContext& context, const std::vector<TileJob>& tiles, const Workers& workers) {
    std::vector<RecordedRays> by_tile(tiles.size());
    std::vector<std::unique_ptr<TileScratch>> scratch(workers.threads());
    for (auto& s : scratch) s = std::make_unique<TileScratch>();
    workers.for_each(int64_t(tiles.size()), {},
                     [&](int64_t i, unsigned worker) { by_tile[size_t(i)] = record_tile(context, tiles[size_t(i)], *scratch[worker]); });
    RecordedRays all;
    for (RecordedRays& rays : by_tile)
        for (const RayKind kind : ray_kinds)
            std::move(of_kind(rays, kind).begin(), of_kind(rays, kind).end(), std::back_inserter(of_kind(all, kind)));
    return all;
}

int64_t count_rays(const std::vector<RayBatch>& batches) {
    int64_t sum = 0;
    for (const RayBatch& batch : batches) sum += batch.count;
    return sum;
}

void replay(const Accel& accel, const RecordedRays& rays, RayKind kind, const Workers& workers) {
    const std::vector<RayBatch>& batches = rays[size_t(kind)];
    std::vector<HitColumns> hits(workers.threads());
    std::vector<Column<uint8_t>> blocked(workers.threads());
    workers.for_each(int64_t(batches.size()), {}, [&](int64_t i, unsigned worker) {
        const RayBatch& batch = batches[size_t(i)];
        HitColumns& h = hits[worker];
        if (kind == RayKind::shadow && batch.blends)
            accel.transmittance(arrays_of(batch), batch.count, batch.coherent, h.t);
        else if (kind == RayKind::shadow)
            accel.occluded(arrays_of(batch), batch.count, batch.coherent, blocked[worker]);
        else
            accel.intersect(arrays_of(batch), batch.count, batch.coherent, {h.t, h.u, h.v, h.geometry, h.instance, h.triangle});
    });
}

} // namespace blush::bench
