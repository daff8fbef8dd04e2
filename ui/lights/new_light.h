// Position and intensity of a new light. Pure; positions in world metres.
#pragma once

#include "scene/document/edit.h"
#include "ui/viewport/picking.h"

namespace blush {

struct LightPlacement {
    Vec3d position{0, 0, 0}, target{0, 0, 0};
    double strength = 1; // factor of the strength that displays a white surface at the target as white
};

// In front of the surface, on the viewer's side.
LightPlacement placement_above_surface(const Scene& scene, const View& view, const SurfacePoint& surface);
// Around the view's pivot: key, fill and rim position, then positions between them; the first free one. Outside of `subject`,
// unless the viewer is inside it (a room). A position is free if the new light does not touch another one.
LightPlacement placement_around_subject(const Scene& scene, const View& view, const Bounds& subject);

// A light at the position, aimed at its target, for this exposure.
AddLight new_light(Light::Kind kind, const View& view, const LightPlacement& spot, float exposure_ev);

} // namespace blush
