// Light for a scene that has none: the edits that add a studio or a sky to it. Shared by `blush render --light` and the window.
#pragma once

#include "core/result.h"
#include "scene/edit.h"

#include <string_view>
#include <vector>

namespace blush {

enum class LightRig : uint8_t {
    none,
    studio, // three softboxes (key, fill, rim) and an environment map of a studio
    sky,    // the Preetham sky with its sun
};
Result<LightRig> parse_light_rig(std::string_view text); // "none", "studio", "sky"
std::string_view to_string(LightRig rig);

// False if nothing in the scene gives light: no visible light that is switched on, no visible surface that emits, no environment that lights.
// Mute and solo count. A scene whose visible surfaces are all unlit needs no light: true.
bool has_light(const Scene& scene);

// The illuminance, in lux, that a rig gives a surface at the middle of the scene that faces its brightest light. With it a matte surface
// of reflectance 0.5 has a luminance of about 0.45 nits: well exposed at an exposure of 0.
constexpr double rig_key_lux = 1.8, rig_fill_lux = 0.6, rig_rim_lux = 1.2, rig_environment_lux = 0.7, rig_sky_lux = 3.0;

// Edits that add the rig; apply them in this order, as one step. Empty for `none`.
//
// Studio: three rectangle lights about the sphere around all visible geometry, at 3.5 of its radii from its middle, as large as it is and aimed at
// it, on the sides that the view gives them: key 40 degrees to the left and 35 above, fill 50 to the right, rim behind and above. Where something
// stands in the way, as the walls of a room, a softbox moves in front of it and shrinks, so that its illuminance stays. If the eye is inside the
// scene, the rig stands about the point that the view turns about. The camera does not see the softboxes. `studio_map`: the environment, an
// image of mean radiance 1; without an image, a constant one.
// Sky: the scene's own sky settings, its intensity such that level ground gets rig_sky_lux.
std::vector<Edit> light_rig_edits(const Scene& scene, LightRig rig, const Environment& studio_map);

// `scene` with those edits. Errors: as of apply().
Result<Scene> with_light_rig(const Scene& scene, LightRig rig, const Environment& studio_map);

} // namespace blush
