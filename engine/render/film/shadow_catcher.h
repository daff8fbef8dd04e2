// Shadow catchers: objects that the camera sees only by the shadows on them, for compositing.
//
// As in Cycles ("Shadow Catcher") and Arnold (shadow_matte): at a first hit on a catcher the direct light of all lights is
// estimated by NEE, once as if only catchers were in the scene, U, and once with all occluders, A. Over the samples of a pixel
// the shadow's opacity is
//
//     alpha = 1 - sum(A) / sum(U)   (luminance; 0 where U is 0)
//
// a ratio of two sums over the same samples, whose bias falls with their number. The shadow is black, premultiplied (0, 0, 0,
// alpha), over the background behind the catcher: the environment, other objects, or nothing. All other rays (reflections,
// indirect light, shadows) see the catcher as an ordinary surface with its material, so that it reflects light onto the objects.
// Shadows of catchers on catchers are part of U and invisible. Indirect light is in neither sum. Through glass and in mirrors a
// catcher is an ordinary surface.
#pragma once

#include "core/exact_sum.h"
#include "render/kernels/kernel.h"

#include <cstdint>
#include <span>

namespace blush {

// Mask of shadow rays that only catchers block.
constexpr uint32_t catcher_ray_mask = uint32_t(1) << 31;

// Catcher results of a tile's samples, by slot.
struct CatcherColumns {
    Column<uint8_t> caught;             // 1: the first surface, including catchers, is a catcher
    Column<float> unoccluded, arriving; // luminance of the direct light, without and with other objects
};

// The same, summed over samples in a film.
struct CaughtSums {
    ExactSum unoccluded, arriving;
    double open = 0;    // samples with nothing behind the catcher, if the background is transparent
    ExactSum3 radiance; // behind the catcher
};

// Opacity of a shadow, 0 .. 1, by the formula above.
inline double shadow_alpha(double unoccluded, double arriving) {
    if (!(unoccluded > 0)) return 0;
    const double open = arriving / unoccluded;
    return open >= 1 ? 0 : open <= 0 ? 1 : 1 - open;
}

// Per-worker memory.
struct CatcherScratch {
    TileScratch tile;
    CatcherColumns columns;
};

// For each sample of the tile, with the kernels' random numbers: follows the camera ray to the first surface and, if that is a
// catcher, estimates its direct light. `is_catcher`: by part of the scene, 1 or 0. Adds the shadow rays to
// scratch.tile.shadow_rays.
void catch_shadows(KernelContext context, std::span<const uint8_t> is_catcher, const TileJob& job, CatcherScratch& scratch);

} // namespace blush
