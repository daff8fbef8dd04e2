// Instances whose transform is not (or barely) invertible: flattened along an axis, nearly
// flattened, or far too small. The BVH transforms rays by the inverse, so such an instance
// gets its own mesh, with the offending part of the transform baked into the vertices.
#pragma once

#include "core/result.h"
#include "render/compile/object_list.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace blush {

// Least singular value of an instance transform, in metres per unit: this fraction of the
// largest singular value, this absolute value, and this fraction of the distance from the
// origin. The inverse is then exact to about 1 % and keeps rays within Embree's range of 1.8e18.
constexpr double min_relative_scale = 1e-5, min_absolute_scale = 1e-9, min_scale_by_distance = 1e-15;
// Limit of copied triangles; a scene with more triangles of its own may copy as many as those.
constexpr size_t max_baked_triangles = size_t(1) << 22;

struct PlaceSplit {
    bool has_area = true;   // false: flattened to a line or a point, or not finite in single precision
    bool invertible = true; // an instance may use the transform unchanged
    // If not invertible but has area: transform = place * stretch. `place` is invertible, `stretch` is baked into the vertices.
    Affined place, stretch;
};
// One-sided Jacobi (Hestenes 1958). In `place`, an axis of length zero is replaced by one perpendicular to the others.
PlaceSplit split_place(const Affined& transform);

class BakedTransforms {
public:
    using Stretch = std::array<double, 9>; // column-major
    // Replaces instances without a usable inverse by objects with their own meshes, each placed after the object that it comes
    // from; instances with equal stretch share a mesh. Removes instances that are flattened to nothing and those beyond
    // max_baked_triangles, and adds a warning for each affected node and for other objects that are. Meshes of the last call are
    // reused.
    void bake(const Scene& scene, std::vector<SceneObject>& objects, std::vector<Diagnostic>& left_out);

private:
    using Shapes = std::map<std::pair<uint64_t, Stretch>, GeometryPtr>; // by serial of the original geometry
    GeometryPtr baked(const GeometryPtr& geometry, const Stretch& stretch, Shapes& used) const;

    Shapes known_;
};

} // namespace blush
