// A rendered picture as a measurement: what its regions are on average, and how sure that is.
#pragma once

#include "render/renderer.h"

#include <vector>

namespace blush::stability {

// A mean and its standard error, RGB.
struct Measured {
    Vec3d mean{0, 0, 0}, error{0, 0, 0};
};

struct Picture {
    int width = 0, height = 0;
    std::vector<Vec3d> pixels, errors; // errors: of each pixel's mean, from its two halves; empty for a single sample
    Frame frame;

    const Vec3d& at(int x, int y) const { return pixels[size_t(y) * size_t(width) + size_t(x)]; }
    // Pixels are independent, so variances add up. Each is estimated from one difference: take regions of 64 pixels and more.
    Measured region(int x, int y, int w, int h) const;
    Measured whole() const { return region(0, 0, width, height); }
    // Regions of w x h pixels side by side, by rows.
    std::vector<Measured> blocks(int w, int h) const;
};

// Of width x height with spp samples and a filter one pixel wide: a pixel is the mean over its square.
RenderSettings settings_for(int width, int height, int64_t spp);
// Samples [first_sample, spp) of the settings on one thread, sound or not.
Picture render_anything(const Scene& scene, const RenderSettings& settings, const PlaneSet& planes = {});
// The same; throws std::runtime_error if samples were dropped or paths cut off, because then the picture is no measurement.
Picture render(const Scene& scene, const RenderSettings& settings, const PlaneSet& planes = {});
// Of what a renderer holds.
Picture picture_of(const Renderer& renderer);

} // namespace blush::stability
