// Where a new light goes and how bright it is. Pure; positions in world metres.
#pragma once

#include "scene/edit.h"
#include "ui/picking.h"

namespace blush {

struct LightSpot {
    Vec3d position{0, 0, 0}, target{0, 0, 0};
    double strength = 1; // times what shows a white surface at the target as white
};

// Before the surface, on the viewer's side of it.
LightSpot spot_over_surface(const Scene& scene, const View& view, const SurfaceSpot& surface);
// Round the view's pivot: key, fill, rim, then places between them; the first that is free. Outside of `subject`, unless the eye is in it (a room).
// A place is free where the new light would touch no other.
LightSpot spot_round_subject(const Scene& scene, const View& view, const Bounds& subject);

// A light at the spot, aimed at its target, for this exposure.
AddLight new_light(Light::Kind kind, const View& view, const LightSpot& spot, float exposure_ev);

} // namespace blush
