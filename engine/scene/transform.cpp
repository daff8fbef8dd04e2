// Converts local transforms to matrices and back; views through cameras.
#include "scene/affine.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

Vec3d normalized_or_zero(const Vec3d& a) { return length(a) > 0 ? normalize(a) : Vec3d{0, 0, 0}; }

// Axes of a matrix, made right-handed and orthonormal. Columns of zero scale are reconstructed from the others, so that flattened
// objects keep their rotation.
Affined rotation_of(const Affined& m) {
    Vec3d z = normalized_or_zero(m.z), y = normalized_or_zero(m.y);
    const Vec3d x = normalized_or_zero(m.x);
    if (length(z) == 0) z = normalized_or_zero(cross(x, y));
    if (length(z) == 0) z = length(y) > 0 ? any_perpendicular(y) : length(x) > 0 ? any_perpendicular(x) : Vec3d{0, 0, 1};
    if (length(y) == 0) y = cross(z, x);
    Vec3d right = normalized_or_zero(cross(y, z));
    if (length(right) == 0) right = any_perpendicular(z);
    return {right, cross(z, right), z, {0, 0, 0}};
}

// Largest deviation of `m` from the matrix of `trs`, relative to the size of its columns.
double relative_error(const Affined& m, const Transform& trs) {
    const Affined n = to_affine(trs);
    const double scale = std::max({length(m.x), length(m.y), length(m.z)});
    const double columns = std::max({length(m.x - n.x), length(m.y - n.y), length(m.z - n.z)});
    const double shift = length(m.t - n.t);
    return std::max(scale > 0 ? columns / scale : columns, length(m.t) > 0 ? shift / length(m.t) : shift);
}

} // namespace

Affined to_affine(const Transform& transform) {
    if (transform.matrix) return to_double(*transform.matrix);
    const Affined r = to_affine(transform.rotation);
    const Vec3d s = to_double(transform.scale);
    return {r.x * s.x, r.y * s.y, r.z * s.z, to_double(transform.translation)};
}

Transform to_transform(const Affined& matrix) {
    Transform trs;
    trs.matrix = to_float(matrix);
    if (!is_finite(matrix)) return trs;
    const Affined rotation = rotation_of(matrix);
    trs.translation = to_float(matrix.t);
    trs.rotation = to_quat(rotation);
    // Signed lengths: a mirrored axis gives a negative scale.
    trs.scale = to_float(Vec3d{dot(matrix.x, rotation.x), dot(matrix.y, rotation.y), dot(matrix.z, rotation.z)});
    Transform without_matrix = trs;
    without_matrix.matrix.reset();
    return relative_error(matrix, without_matrix) <= 1e-5 ? without_matrix : trs;
}

View view_of_camera(const Scene& scene, Id<Node> camera_node) {
    const Node* node = scene.nodes.find(camera_node);
    const Camera* camera = node ? scene.cameras.find(node->camera) : nullptr;
    if (!camera) return scene.view;
    const Affined world_from_camera = world_from_node(scene, camera_node);
    View view;
    view.position = to_float(world_from_camera.t);
    view.rotation = to_quat(rotation_of(world_from_camera));
    view.lens = camera->lens;
    return view;
}

View view_through(const Scene& scene, Id<Node> camera_node) {
    const Node* node = scene.nodes.find(camera_node);
    if (!node || !scene.cameras.contains(node->camera)) return scene.view;
    const Vec3d eye = world_from_node(scene, camera_node).t;
    View view = view_of_camera(scene, camera_node);
    // Pivot for orbiting: the point on the view axis nearest to the centre of the scene.
    const Bounds bounds = world_bounds(scene);
    const Vec3d forward = to_affine(view.rotation).z * -1;
    const double to_middle = bounds.empty ? 0 : dot(bounds.center() - eye, forward);
    if (to_middle > 1e-3 * bounds.radius()) view.pivot_distance = float(to_middle);
    return view;
}

} // namespace blush
