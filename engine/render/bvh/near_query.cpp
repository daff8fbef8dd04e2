#include "render/bvh/near_query.h"

#include <embree3/rtcore.h>

namespace blush {
namespace {

struct Query {
    const NearScenes& scenes;
    const NearVisitor& visit;
    // Of the scene that is searched:
    uint32_t first_mesh = 0, meshes = 0;
    bool ended = false;
};

// Returns whether it changed the radius.
bool visit_primitive(RTCPointQueryFunctionArguments* args) {
    Query& query = *static_cast<Query*>(args->userPtr);
    if (query.ended) return false;
    const RTCPointQueryContext& context = *args->context;
    const bool in_instance = context.instStackSize > 0;
    if (!in_instance && args->geomID >= query.meshes) return false;
    const NearTriangle triangle{int32_t(in_instance ? args->geomID : query.first_mesh + args->geomID),
                                in_instance ? int32_t(context.instID[0] - query.scenes.first_instance) : -1, int32_t(args->primID)};
    if (query.visit(triangle)) return false;
    query.ended = true;
    args->query->radius = 0; // nearly all that is left is too far away
    return true;
}

void search(RTCScene scene, const Vec3& center, float radius, Query& query) {
    RTCPointQuery point{center.x, center.y, center.z, 0, radius};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene, &point, &context, visit_primitive, &query);
}

} // namespace

void visit_near(const NearScenes& scenes, const Vec3& center, float radius, const NearVisitor& visit) {
    Query query{scenes, visit, 0, scenes.first_instance};
    search(scenes.top, center, radius, query);
    if (!scenes.area_lights || query.ended) return;
    query.first_mesh = scenes.first_area_light;
    query.meshes = scenes.area_light_meshes;
    search(scenes.area_lights, center, radius, query);
}

} // namespace blush
