#include "scene/lights/light_meter.h"

#include "core/math.h"
#include "scene/affine.h"

namespace blush {
namespace {

Affined world_of(const Scene& scene, Id<Node> node) { return scene.nodes.contains(node) ? world_from_node(scene, node) : Affined{}; }

} // namespace

PlacedMeter placed(const Scene& scene, const LightMeter& meter) {
    const Affined world = world_of(scene, meter.node);
    Vec3d normal = transform_vector(cofactor(world), to_double(meter.normal));
    // A mirroring transform flips the orientation, and the sign of the cofactors.
    if (determinant(world) < 0) normal = -normal;
    const double l = length(normal);
    return {transform_point(world, to_double(meter.position)), l > 0 ? normal / l : to_double(meter.normal)};
}

LightMeter meter_on(const Scene& scene, Id<Node> node, const Vec3d& position, const Vec3d& normal, std::string name) {
    const Affined world = world_of(scene, node);
    LightMeter meter{std::move(name), {}, to_float(position), to_float(normal)};
    if (!scene.nodes.contains(node) || determinant(world) == 0) return meter;
    const Affined local = inverse(world);
    const Affined turned = {
        {world.x.x, world.y.x, world.z.x}, {world.x.y, world.y.y, world.z.y}, {world.x.z, world.y.z, world.z.z}, {0, 0, 0}};
    meter.node = node;
    meter.position = to_float(transform_point(local, position));
    meter.normal = to_float(normalize(transform_vector(turned, normal)));
    return meter;
}

} // namespace blush
