// Projection between world and image for a View. Image coordinates go from (0, 0) top left to (1, 1) bottom right.
#pragma once

#include "core/vec.h"
#include "scene/scene.h"

#include <optional>

namespace blush {

struct ViewRay {
    Vec3d origin;
    Vec3d direction; // unit length
};

struct ImagePoint {
    double u = 0, v = 0;
    double distance = 0; // metres along the view axis
};

class Projection {
public:
    // `aspect` is width / height of the image.
    Projection(const View& view, double aspect);

    // nullopt for points behind the viewer.
    std::optional<ImagePoint> project(const Vec3d& world) const;
    // The ray through a point of the image, from the camera position (perspective) or from the image plane (orthographic).
    ViewRay ray(double u, double v) const;
    // Height in metres that the image covers at a distance along the view axis.
    double height_at(double distance) const;
    // Converts metres along the ray through (u, v), as in a depth plane, to metres along the view axis.
    double axial_distance(double u, double v, double along_ray) const;

    Vec3d eye() const { return eye_; }
    Vec3d right() const { return right_; }
    Vec3d up() const { return up_; }
    Vec3d forward() const { return forward_; }

private:
    Vec3d eye_, right_, up_, forward_;
    double aspect_;
    bool orthographic_;
    double half_height_; // orthographic: metres; perspective: at distance 1
};

} // namespace blush
