// Closed scenes of a few triangles, which are traced faster by testing all of them than by a BVH (brute_force.h).
#pragma once

#include "render/bvh/accel_scene.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace blush {

struct SmallScene {
    struct Triangle {
        int32_t geometry; // index in Accel
        int32_t index;    // in its geometry
        int32_t turn;     // position (0 to 2) of its first vertex among the three vertices of its half of the face
    };
    // A convex quadrilateral, split into the triangles (0, 1, 2) and (0, 2, 3) of its vertices; or one triangle: its fourth vertex
    // repeats the first.
    struct Face {
        int32_t vertices[4]; // indices of `positions`
        uint32_t mask;
    };
    // Faces in the same plane share one intersection of the ray with that plane.
    struct Plane {
        Vec3 normal; // unit
        Vec3 point;
        int32_t end = 0; // index behind its last face; its first face is the previous plane's `end`
    };
    static constexpr int max_triangles = 64, max_positions = 3 * max_triangles;

    std::vector<Vec3> positions;     // each once, so that triangles that touch share them
    std::vector<Triangle> triangles; // two for each face; the second is not used if it is a triangle
    std::vector<Face> faces;
    std::vector<Plane> planes;
    bool masked = false; // some face is hidden from some rays
};

// Returns nothing unless the scene consists of 1 to max_triangles triangles only (no instances, spheres or opacity), and their total
// area is at least 0.8 of the area of the bounding box, as in a room. Scenes with a triangle narrower than 1e-4 of the scene's diagonal
// are left to the BVH: rounding moves a projected vertex by about 1e-7 of its distance from the ray's origin. Triangles of zero area
// are omitted: no ray hits them.
std::optional<SmallScene> make_small_scene(const AccelScene& scene);

} // namespace blush
