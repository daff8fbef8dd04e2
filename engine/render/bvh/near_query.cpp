#include "render/bvh/near_query.h"

#include "core/math.h"
#include "render/compile/scene_tables.h"
#include "scene/affine.h"

#include <cmath>
#include <embree3/rtcore.h>

namespace blush {
namespace {

struct Query {
    const NearVisitor& visit;
    // Of the scene that is searched:
    uint32_t first_mesh = 0, meshes = 0;
    int32_t instance = -1;
    bool ended = false;
};

// Returns whether it changed the radius.
bool visit_primitive(RTCPointQueryFunctionArguments* args) {
    Query& query = *static_cast<Query*>(args->userPtr);
    if (query.ended || args->context->instStackSize > 0 || args->geomID >= query.meshes) return false;
    if (query.visit({int32_t(query.first_mesh + args->geomID), query.instance, int32_t(args->primID)})) return false;
    query.ended = true;
    args->query->radius = 0; // nearly all that is left is too far away
    return true;
}

void search(RTCScene scene, const Vec3& center, float radius, Query& query) {
    if (query.ended) return;
    RTCPointQuery point{center.x, center.y, center.z, 0, radius};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene, &point, &context, visit_primitive, &query);
}

// Whether the transformed box comes within `radius` of `center`.
bool is_near(const Vec3d& low, const Vec3d& high, const Affined& world_from_box, const Vec3d& center, double radius) {
    const Vec3d away = transform_point(world_from_box, (low + high) * 0.5) - center, half = (high - low) * 0.5;
    const Affined& m = world_from_box;
    const auto outside = [&](double distance, double x, double y, double z) {
        return std::abs(distance) - std::abs(x) * half.x - std::abs(y) * half.y - std::abs(z) * half.z;
    };
    return !(outside(away.x, m.x.x, m.y.x, m.z.x) > radius || outside(away.y, m.x.y, m.y.y, m.z.y) > radius ||
             outside(away.z, m.x.z, m.y.z, m.z.z) > radius);
}

// Embree 3.13's own queries miss triangles in instances that are scaled down evenly, so each mesh is asked in its own space.
void search_instances(const NearScenes& scenes, const Vec3& center, float radius, Query& query) {
    query.first_mesh = 0;
    query.meshes = RTC_INVALID_GEOMETRY_ID;
    query.instance = 0;
    for (const MeshInstances& group : scenes.instances) {
        RTCBounds b;
        rtcGetSceneBounds(group.mesh, &b);
        const Vec3d low{b.lower_x, b.lower_y, b.lower_z}, high{b.upper_x, b.upper_y, b.upper_z};
        for (size_t i = 0; i < group.count && !query.ended; ++i, ++query.instance) {
            const Affined place = to_double(scenes.places[query.instance].world_from_object);
            if (!is_near(low, high, place, to_double(center), double(radius))) continue;
            const Affined back = inverse(place);
            const double norm = std::sqrt(dot(back.x, back.x) + dot(back.y, back.y) + dot(back.z, back.z));
            search(group.mesh, to_float(transform_point(back, to_double(center))), float(1.01 * norm * double(radius)), query);
        }
    }
}

} // namespace

void visit_near(const NearScenes& scenes, const Vec3& center, float radius, const NearVisitor& visit) {
    Query query{visit, 0, scenes.flat_meshes};
    search(scenes.top, center, radius, query);
    if (scenes.area_lights) {
        query.first_mesh = scenes.first_area_light;
        query.meshes = scenes.area_light_meshes;
        search(scenes.area_lights, center, radius, query);
    }
    search_instances(scenes, center, radius, query);
}

} // namespace blush
