#include "render/bvh/opacity_filter.h"

#include "core/sampler.h"
#include "render/bvh/opacity.h"
#include "render/bvh/transmittance.h"
#include "render/compile/scene_tables.h"

namespace blush {
namespace {

// Whether a blended hit counts, with probability `opacity`: decided by a hash of the ray's random number, the triangle and the
// instance, so the result does not depend on how often or in which order Embree calls the filter.
bool stops_by_chance(const RTCFilterFunctionNArguments& args, unsigned i, int32_t part, float opacity, uint32_t random) {
    const uint32_t triangle = RTCHitN_primID(args.hit, args.N, i);
    const uint32_t place = pcg_hash(uint32_t(part) ^ pcg_hash(RTCHitN_instID(args.hit, args.N, i, 0)));
    return unit_float<float>(pcg_hash(random ^ pcg_hash(triangle ^ place))) < opacity;
}

bool is_pane(const AlphaPart& alpha) {
    return alpha.tables->materials.materials[alpha.tables->parts[alpha.part].material].flags & material_pane;
}

} // namespace

void opacity_filter(const RTCFilterFunctionNArguments* args) {
    const AlphaPart& alpha = *static_cast<const AlphaPart*>(args->geometryUserPtr);
    TraceContext& context = *reinterpret_cast<TraceContext*>(args->context);
    const uint32_t* randoms = context.blended != Blended::by_chance && context.random && is_pane(alpha) ? context.random : nullptr;
    const bool by_chance = context.blended == Blended::by_chance || randoms;
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const int32_t triangle = int32_t(RTCHitN_primID(args->hit, args->N, i));
        const float opacity =
            opacity_at_hit(*alpha.tables, alpha.part, triangle, RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i));
        if (opacity >= 1) continue;
        args->valid[i] = 0;
        if (opacity <= 0) continue; // masks need no random number
        const uint32_t id = RTCRayN_id(args->ray, args->N, i);
        if (by_chance)
            args->valid[i] = -int(stops_by_chance(*args, i, alpha.part, opacity, randoms ? randoms[id] : id));
        else if (context.blended == Blended::attenuating)
            args->valid[i] = -int((context.depth[id] += optical_depth(1 - opacity)) > context.limit[id]);
    }
}

} // namespace blush
