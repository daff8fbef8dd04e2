// Closed scenes of a few triangles, which are traced faster by testing all of them than by a BVH (brute_force.h).
#pragma once

#include "render/bvh/accel_scene.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace blush {

struct SmallScene {
    struct Triangle {
        int32_t geometry; // as Accel numbers it
        int32_t index;    // in its geometry
        int32_t turn;     // its first vertex is this one of those that its face gives it
    };
    // A convex quadrilateral of the triangles (0, 1, 2) and (0, 2, 3) of its vertices, or one triangle, whose fourth vertex is its first.
    struct Face {
        int32_t vertices[4]; // indices of `positions`
        uint32_t mask;
    };
    // Faces in one plane are intersected with it together.
    struct Plane {
        Vec3 normal; // unit
        Vec3 point;
        int32_t end = 0; // it has the faces up to this one, from the end of the plane before it on
    };
    static constexpr int max_triangles = 64, max_positions = 3 * max_triangles;

    std::vector<Vec3> positions;     // each once, so that triangles that touch share them
    std::vector<Triangle> triangles; // two for each face; the second is not used if it is a triangle
    std::vector<Face> faces;
    std::vector<Plane> planes;
    bool masked = false; // some face is hidden from some rays
};

// Nothing unless the scene has 1 to max_triangles flat triangles and nothing else: no instances, spheres or opacity; and their area is
// at least 0.8 of that of their bounding box, as in a room. Their scale must be similar, too: rounding moves a projected vertex by about
// 1e-7 of its distance from the ray's origin, so triangles that are narrower than 1e-4 of the scene's diagonal are left to the BVH.
// Triangles without area are omitted: no ray hits them.
std::optional<SmallScene> make_small_scene(const AccelScene& scene);

} // namespace blush
