// Instances whose transform has no usable inverse: flattened along an axis, nearly so, or far too small. The ray tracer transforms
// rays by that inverse, so such a place gets a shape of its own, with the offending part of the transform baked into its vertices.
#pragma once

#include "core/result.h"
#include "render/object_list.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace blush {

// Least singular value of a transform that an instance may have, in metres per unit: this share of the largest one, this size, and this
// share of the distance from the origin. Its inverse is then exact to about a hundredth and keeps rays within the ray tracer's range of 1.8e18.
constexpr double min_relative_scale = 1e-5, min_absolute_scale = 1e-9, min_scale_by_distance = 1e-15;
// Triangles that may be copied; a scene that has more of its own may copy as many as those.
constexpr size_t max_baked_triangles = size_t(1) << 22;

struct PlaceSplit {
    bool has_area = true;   // false: flattened to a line or a point, or not finite in single precision
    bool invertible = true; // an instance may have the transform as it is
    // Where it is not invertible but has area: transform = place * stretch. `place` may be inverted, `stretch` belongs in the vertices.
    Affined place, stretch;
};
// One-sided Jacobi (Hestenes 1958). An axis that the transform wipes out is replaced in `place` by one at right angles to the others.
PlaceSplit split_place(const Affined& transform);

class BakedTransforms {
public:
    using Stretch = std::array<double, 9>; // by columns
    // Among instanced objects, replaces places without a usable inverse by objects with shapes of their own, each behind the object that it
    // comes from; places with equal stretch share a shape. Removes places that have no area and those beyond max_baked_triangles, and adds
    // a warning for each node that lost some. Shapes that the last call made are used again.
    void bake(const Scene& scene, std::vector<SceneObject>& objects, std::vector<Diagnostic>& left_out);

private:
    using Shapes = std::map<std::pair<uint64_t, Stretch>, GeometryPtr>; // by serial of the shape that they are made of
    GeometryPtr baked(const GeometryPtr& geometry, const Stretch& stretch, Shapes& used) const;

    Shapes known_;
};

} // namespace blush
