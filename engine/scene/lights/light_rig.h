// Light rigs for a scene without light: the edits that add a studio or a sky. Shared by `blush render --light` and the window.
#pragma once

#include "core/result.h"
#include "scene/document/edit.h"

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

// True if the scene has a visible enabled light, a visible emissive surface or an environment that lights it; mute and solo
// count. Also true if all visible surfaces are unlit, since they need no light.
bool has_light(const Scene& scene);

// Illuminance in lux at the centre of the scene, on a surface that faces the light. A diffuse surface of reflectance 0.5 then has
// a luminance of about 0.45 nits: well exposed at exposure 0.
constexpr double rig_key_lux = 1.8, rig_fill_lux = 0.6, rig_rim_lux = 1.2, rig_environment_lux = 0.7, rig_sky_lux = 3.0;

// Edits that add the rig; apply them in this order as one undo step. Empty for `none`.
//
// Studio: three rectangle lights around the bounding sphere of all visible geometry, at 3.5 radii from its centre, about as large
// as the sphere and aimed at its centre. Relative to the view: key 40 degrees to the left and 35 up, fill 50 to the right, rim
// behind and above. If geometry is in the way, such as the walls of a room, the softbox moves in front of it and shrinks, so that
// its illuminance stays the same. If the camera is inside the scene, the rig is placed around the view's pivot. The softboxes are
// invisible to the camera. `studio_map`: the environment, an image of mean radiance 1; without an image, a constant environment.
// Sky: the scene's sky settings, with an intensity that gives horizontal ground rig_sky_lux.
std::vector<Edit> light_rig_edits(const Scene& scene, LightRig rig, const Environment& studio_map);

// `scene` after those edits. Errors: as of apply().
Result<Scene> with_light_rig(const Scene& scene, LightRig rig, const Environment& studio_map);

} // namespace blush
