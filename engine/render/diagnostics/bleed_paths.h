// Paths of a pixel, a rectangle or a surface point, whose light is kept apart by who sent it there last, by light and by bounce. They run
// through the stages of the kernels, one lane at a time: this is the estimator of the image (estimator.h), without path reuse, light
// paths, manifold sampling and what pilots learn, which change its variance and not its expectation.
#pragma once

#include "core/vec.h"
#include "render/integrator/irradiance.h"
#include "scene/image_region.h"

#include <array>
#include <compare>
#include <cstdint>
#include <map>

namespace blush {

// Who sent light to the probed surface: the surface itself (it emits, or a light or the background is seen directly), a light, or an object
// that scattered it.
enum class SentBy : uint8_t { itself, light, object };
struct BleedSender {
    SentBy by = SentBy::itself;
    int32_t id = 0; // light: index of its group, or glowing_pane; object: Id<Node>.value
    auto operator<=>(const BleedSender&) const = default;
};
// Emission of window panes, which paths add as they pass: its group is not known.
constexpr int32_t glowing_pane = -1;

// By number of scatterings; the last holds all further ones.
constexpr int bleed_bounces = 9;

// What is probed.
struct BleedTarget {
    enum class Kind : uint8_t {
        pixels,   // radiance that the camera receives, mean over a rectangle of pixels, nits
        outgoing, // radiance of a surface point towards the camera, nits
        incoming, // irradiance of a surface point, lux
    };
    Kind kind = Kind::pixels;
    PixelRect pixels;
    Vec3d position{0, 0, 0}, normal{0, 1, 0}; // of the point, world space, metres
    double clearance = 0;                     // offset in metres from the surface, against self-shadowing
    bool operator==(const BleedTarget&) const = default;
};

// Light of one sender.
struct BleedFlow {
    Vec3d light{0, 0, 0};
    Vec3d places{0, 0, 0}; // sum over its light of luminance times where it left the sender, relative to the scene's origin; or of the unit
                           // directions towards a sender at infinity
    double weight = 0;     // sum of these luminances
    bool infinite = false;
};

// Means over the samples of one batch: nits or lux, linear Rec.709. The light of the senders, that of the lights, and that of the bounces
// have the same sum.
struct BleedSums {
    std::map<BleedSender, BleedFlow> senders;
    std::map<int32_t, Vec3d> lights; // by index of the light group; glowing_pane
    std::array<Vec3d, bleed_bounces> bounces{};
    Vec3d places{0, 0, 0}; // sum of the probed points, relative to the scene's origin
    int64_t hits = 0;      // number of these
    int64_t dropped = 0;   // samples that are not finite or negative, which the film drops as well
};

constexpr int bleed_batch_paths = 256;

// Traces batch `batch`. Batches are independent of each other; the samples of one are stratified. Batch 0 of a single pixel has the film's
// samples 0 to bleed_batch_paths - 1. `context.scene` needs groups of lights. `origin`: of the scene. Call it from within Workers::run or
// for_each.
BleedSums trace_bleed_batch(KernelContext context, const BleedTarget& target, const Vec3d& origin, int64_t batch, TileScratch& scratch);

} // namespace blush
