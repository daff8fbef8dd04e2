// A rendered image as a measurement: means of regions with standard errors.
#pragma once

#include "render/renderer.h"

#include <vector>

namespace blush::stability {

// A mean and its standard error, RGB.
struct Measured {
    Vec3d mean{0, 0, 0}, error{0, 0, 0};
};

struct RenderedImage {
    int width = 0, height = 0;
    std::vector<Vec3d> pixels, errors; // errors: standard error of each pixel from its A/B buffers; empty for a single sample
    Frame frame;

    const Vec3d& at(int x, int y) const { return pixels[size_t(y) * size_t(width) + size_t(x)]; }
    // Variances are added: errors of neighbouring pixels mostly cancel (core/sampler.h), and count as independent. Each is estimated from
    // one difference: use regions of at least 64 pixels.
    Measured region(int x, int y, int w, int h) const;
    Measured whole() const { return region(0, 0, width, height); }
    // Adjacent regions of w x h pixels, by rows.
    std::vector<Measured> blocks(int w, int h) const;
};

// Settings for width x height pixels and spp samples with a box filter: a pixel is the mean over its area.
RenderSettings settings_for(int width, int height, int64_t spp);
// Renders samples [first_sample, spp) on one thread, without checks.
RenderedImage render_anything(const Scene& scene, const RenderSettings& settings, const PlaneSet& planes = {});
// The same; throws std::runtime_error if samples were dropped or paths truncated, which invalidates the measurement.
RenderedImage render(const Scene& scene, const RenderSettings& settings, const PlaneSet& planes = {});
// The current image of a renderer.
RenderedImage image_of(Renderer& renderer);

} // namespace blush::stability
