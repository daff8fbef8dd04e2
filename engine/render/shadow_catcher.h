// Shadow catchers: objects that the camera does not see, but for the shadows that lie on them, for pictures that are laid over others.
//
// As in Cycles ("Shadow Catcher") and Arnold (shadow_matte): at a first hit on a catcher the direct light of all lights is estimated by light
// sampling, once as if the catchers were alone in the scene, U, and once with everything that stands in its way, A. Over the samples of a
// pixel the shadow's opacity is
//
//     alpha = 1 - sum(A) / sum(U)   (luminance; 0 where U is 0)
//
// a ratio of two sums over the same samples, whose bias falls with their number. The shadow is black, premultiplied (0, 0, 0, alpha), and lies
// over what the camera sees behind the catcher: the environment, other objects, or nothing. All other rays - of reflections, of indirect light,
// of shadows - meet a catcher as an ordinary surface of its material, so that it bounces light onto the objects. Shadows of catchers on catchers
// are part of U, and are not seen. Indirect light is in neither sum. Through glass and in mirrors before it a catcher is an ordinary surface.
#pragma once

#include "render/kernels/kernel.h"

#include <cstdint>
#include <span>

namespace blush {

// Shadow rays that are stopped by catchers alone.
constexpr uint32_t catcher_ray_mask = uint32_t(1) << 31;

// What a tile's samples found on catchers, by slot.
struct CatcherColumns {
    Column<uint8_t> caught;               // 1: the first surface on the way, catchers included, is one
    Column<float> unoccluded, arriving;   // luminance of the direct light, without other objects and with them
};

// The same, summed in a film.
struct CaughtSums {
    double unoccluded = 0, arriving = 0;
    double open = 0;            // samples that see nothing behind the catcher, where the background is transparent
    double r = 0, g = 0, b = 0; // radiance of what is seen behind it
};

// Opacity of a shadow, 0 .. 1, by the formula above.
inline double shadow_alpha(double unoccluded, double arriving) {
    if (!(unoccluded > 0)) return 0;
    const double open = arriving / unoccluded;
    return open >= 1 ? 0 : open <= 0 ? 1 : 1 - open;
}

// A worker's memory for it.
struct CatcherScratch {
    TileScratch tile;
    CatcherColumns columns;
};

// For each sample of the tile, with the random numbers that the kernels give it: follows the camera ray to the first surface and, if that is on
// a catcher, estimates its direct light. `is_catcher`: by part of the scene, 1 or 0. Adds the shadow rays to scratch.tile.shadow_rays.
void catch_shadows(KernelContext context, std::span<const uint8_t> is_catcher, const TileJob& job, CatcherScratch& scratch);

} // namespace blush
