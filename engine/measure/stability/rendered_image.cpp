#include "measure/stability/rendered_image.h"

#include "core/math.h"
#include "scene/affine.h"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace blush::stability {

Measured RenderedImage::region(int x0, int y0, int w, int h) const {
    Measured m;
    for (int y = y0; y < y0 + h; ++y)
        for (int x = x0; x < x0 + w; ++x) {
            const size_t i = size_t(y) * size_t(width) + size_t(x);
            m.mean = m.mean + pixels[i];
            if (!errors.empty()) m.error = m.error + errors[i] * errors[i];
        }
    const double n = double(w) * h;
    m.mean = m.mean / n;
    m.error = Vec3d{std::sqrt(m.error.x), std::sqrt(m.error.y), std::sqrt(m.error.z)} / n;
    return m;
}

std::vector<Measured> RenderedImage::blocks(int w, int h) const {
    std::vector<Measured> all;
    for (int y = 0; y + h <= height; y += h)
        for (int x = 0; x + w <= width; x += w) all.push_back(region(x, y, w, h));
    return all;
}

RenderSettings settings_for(int width, int height, int64_t spp) {
    RenderSettings s;
    s.width = width;
    s.height = height;
    s.spp = spp;
    s.filter = PixelFilter::box;
    return s;
}

RenderedImage render_anything(const Scene& scene, const RenderSettings& settings, const PlaneSet& planes) {
    RendererOptions options;
    options.threads = 1;
    options.planes = planes;
    Renderer renderer(options);
    renderer.update(scene, settings);
    renderer.render(settings.first_sample, settings.spp - settings.first_sample);
    return image_of(renderer);
}

RenderedImage image_of(Renderer& renderer) {
    RenderedImage p;
    p.frame = renderer.resolve();
    p.width = p.frame.width;
    p.height = p.frame.height;
    for (size_t i = 0; i < p.frame.rgba.size(); i += 4) p.pixels.push_back({p.frame.rgba[i], p.frame.rgba[i + 1], p.frame.rgba[i + 2]});
    for (const Vec3& e : renderer.resolve_error()) p.errors.push_back(to_double(e));
    return p;
}

RenderedImage render(const Scene& scene, const RenderSettings& settings, const PlaneSet& planes) {
    RenderedImage p = render_anything(scene, settings, planes);
    const Health& health = p.frame.health;
    if (health.dropped() > 0 || health.truncated > 0)
        throw std::runtime_error(
            fmt::format("{} samples were not finite or negative, {} paths were truncated", health.dropped(), health.truncated));
    return p;
}

} // namespace blush::stability
