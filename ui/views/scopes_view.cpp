#include "ui/views/scopes_view.h"

#include "io/image/display_image.h"
#include "render/film/coverage.h"

#include <cmath>

namespace blush {
namespace {

constexpr double enough_pixels = 130000;
constexpr ScopeAxis stops_axis{true, -8, 8}, display_axis{false, 0, 1};
constexpr int stops_bins = 128, display_bins = 128; // width 1/8 stop; width 2 of 256 levels
constexpr int wave_columns = 160, wave_levels = 64;

// Reads every step-th pixel of every step-th row.
struct Subsampled {
    int width = 0;
    std::vector<float> rgb;
    std::vector<Vec3> albedo;
    std::vector<float> coverage;
};
Subsampled subsampled(const ShownImage& p, int step) {
    const Frame& f = *p.frame;
    Subsampled t;
    for (int y = step / 2; y < f.height; y += step) {
        t.width = 0;
        for (int x = step / 2; x < f.width; x += step, ++t.width) {
            const Vec3 c = mixed_pixel(f, p.denoised.get(), p.mix, x, y);
            t.rgb.insert(t.rgb.end(), {c.x, c.y, c.z});
            const size_t pixel = size_t(y) * size_t(f.width) + size_t(x);
            if (!f.albedo.empty()) t.albedo.push_back(f.albedo[pixel]);
            t.coverage.push_back(coverage_of_pixel(f, pixel));
        }
    }
    return t;
}

} // namespace

Scopes scopes_of(const ShownImage& image) {
    Scopes s;
    s.step = std::max(1, int(std::sqrt(double(image.frame->width) * image.frame->height / enough_pixels)));
    Subsampled t = subsampled(image, s.step);
    s.scene = histogram(t.rgb, stops_axis, stops_bins);
    s.scene_wave = waveform(t.rgb, t.width, stops_axis, wave_columns, wave_levels);
    if (!show(*image.color, image.view, t.rgb, {t.albedo, t.coverage})) return s;
    s.displayed = histogram(t.rgb, display_axis, display_bins);
    s.displayed_wave = waveform(t.rgb, t.width, display_axis, wave_columns, wave_levels);
    return s;
}

} // namespace blush
