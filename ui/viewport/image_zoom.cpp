#include "ui/viewport/image_zoom.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

ImageRect fitted(const Region& region, int width, int height) {
    const Region fit = fit_aspect(region, float(std::max(width, 1)) / float(std::max(height, 1)));
    return {fit.x, fit.y, fit.width, fit.height};
}

// The zoom that shows (u, v) of the image at a position on the screen.
ImageZoom with_at(double scale, const Region& region, int width, int height, double u, double v, double x, double y) {
    return {scale, std::clamp(u + (region.x + region.width / 2.0 - x) / (scale * width), 0.0, 1.0),
            std::clamp(v + (region.y + region.height / 2.0 - y) / (scale * height), 0.0, 1.0)};
}

} // namespace

ImageRect image_rect(const ImageZoom& zoom, const Region& region, int width, int height) {
    if (zoom.scale <= 0) return fitted(region, width, height);
    const double w = std::max(1.0, std::round(zoom.scale * width)), h = std::max(1.0, std::round(zoom.scale * height));
    return {float(std::round(region.x + region.width / 2.0 - zoom.u * w)), float(std::round(region.y + region.height / 2.0 - zoom.v * h)),
            float(w), float(h)};
}

ImageZoom zoomed(const ImageZoom& zoom, const Region& region, int width, int height, ScreenPoint about, double factor) {
    const ImageRect fit = fitted(region, width, height);
    const double before = zoom.scale > 0 ? zoom.scale : double(fit.width) / width, scale = std::clamp(before * factor, min_zoom, max_zoom);
    if (factor < 1 && scale * width <= double(fit.width)) return {};
    // Not from the drawn rectangle: its rounding to whole pixels would accumulate to a drift.
    const double u = zoom.u + (about.x - region.x - region.width / 2.0) / (before * width);
    const double v = zoom.v + (about.y - region.y - region.height / 2.0) / (before * height);
    return with_at(scale, region, width, height, u, v, about.x, about.y);
}

ImageZoom shifted(const ImageZoom& zoom, const Region& region, int width, int height, double dx, double dy) {
    if (zoom.scale <= 0) return zoom;
    const double x = region.x + region.width / 2.0, y = region.y + region.height / 2.0;
    return with_at(zoom.scale, region, width, height, zoom.u, zoom.v, x + dx, y + dy);
}

ImageZoom toggled(const ImageZoom& zoom) { return zoom.scale > 0 ? ImageZoom{} : ImageZoom{1, 0.5, 0.5}; }

} // namespace blush
