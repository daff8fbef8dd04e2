#include "render/bvh/opacity_filter.h"

#include "core/sampler.h"
#include "render/bvh/opacity.h"
#include "render/bvh/transmittance.h"
#include "render/compile/scene_tables.h"

namespace blush {
namespace {

// Whether a blended hit counts, with probability `opacity`. Each triangle of each instance is a dimension of the sampler: so the samples
// of a pixel are stratified there, and the result does not depend on how often or in which order Embree calls the filter.
bool stops_by_chance(const RTCFilterFunctionNArguments& args, unsigned i, int32_t part, float opacity, const Sampler<float>& sampler) {
    const uint32_t triangle = RTCHitN_primID(args.hit, args.N, i);
    const uint32_t place = pcg_hash(uint32_t(part) ^ pcg_hash(RTCHitN_instID(args.hit, args.N, i, 0)));
    return sampler.pair(pcg_hash(triangle ^ place)).x() < opacity;
}

// Takes a hit that is not behind the chosen one.
void choose_nearer(const RTCFilterFunctionNArguments& args, unsigned i, uint32_t lane, ChosenHits& chosen) {
    const float t = RTCRayN_tfar(args.ray, args.N, i);
    const uint32_t triangle = RTCHitN_primID(args.hit, args.N, i);
    // Of hits at one distance, the choice must not depend on the order of traversal.
    if (t == chosen.t[lane] && triangle > chosen.triangle[lane]) return;
    chosen.t[lane] = t;
    chosen.u[lane] = RTCHitN_u(args.hit, args.N, i);
    chosen.v[lane] = RTCHitN_v(args.hit, args.N, i);
    chosen.geometry[lane] = RTCHitN_geomID(args.hit, args.N, i);
    chosen.instance[lane] = RTCHitN_instID(args.hit, args.N, i, 0);
    chosen.triangle[lane] = triangle;
}

bool is_pane(const AlphaPart& alpha) {
    return alpha.tables->materials.materials[alpha.tables->parts[alpha.part].material].flags & material_pane;
}

} // namespace

void opacity_filter(const RTCFilterFunctionNArguments* args) {
    const AlphaPart& alpha = *static_cast<const AlphaPart*>(args->geometryUserPtr);
    TraceContext& context = *reinterpret_cast<TraceContext*>(args->context);
    const bool by_chance = context.blended == Blended::by_chance || (context.blended != Blended::both && context.random && is_pane(alpha));
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const int32_t triangle = int32_t(RTCHitN_primID(args->hit, args->N, i));
        const float opacity =
            opacity_at_hit(*alpha.tables, alpha.part, triangle, RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i));
        if (opacity >= 1) continue;
        args->valid[i] = 0;
        if (opacity <= 0) continue; // masks need no random number
        const uint32_t id = RTCRayN_id(args->ray, args->N, i);
        const auto stops = [&] {
            return stops_by_chance(*args, i, alpha.part, opacity, {context.random[id], context.index ? context.index[id] : 0});
        };
        if (by_chance) {
            args->valid[i] = -int(stops());
        } else if (context.blended == Blended::attenuating) {
            args->valid[i] = -int((context.depth[id] += optical_depth(1 - opacity)) > context.limit[id]);
        } else if (context.blended == Blended::both) {
            if (context.depth[id] <= context.limit[id]) context.depth[id] += optical_depth(1 - opacity);
            const float t = RTCRayN_tfar(args->ray, args->N, i);
            if (t <= context.chosen->t[id] && stops()) choose_nearer(*args, i, id, *context.chosen);
            // Once no light passes, traversal can end at the chosen hit. Embree does not know it, but keeps one at or behind it.
            const bool blocked = context.depth[id] > context.limit[id];
            args->valid[i] = -int(blocked && t >= context.chosen->t[id]);
        }
    }
}

} // namespace blush
