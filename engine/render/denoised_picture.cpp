#include "render/denoised_picture.h"

#include <utility>

namespace blush {
namespace {

PixelView view_of(const std::vector<Vec3>& plane) {
    static_assert(sizeof(Vec3) == 3 * sizeof(float));
    if (plane.empty()) return {};
    return {{&plane.front().x, 3 * plane.size()}, 3};
}

} // namespace

DenoiseInput denoise_input(const Frame& frame) {
    return {frame.width, frame.height, {frame.rgba, 4}, view_of(frame.albedo), view_of(frame.normal)};
}

DenoisedPtr denoised_picture(const Frame& source, DenoiseQuality quality, Denoised denoised) {
    auto picture = std::make_shared<DenoisedPicture>();
    picture->revision = source.revision;
    picture->width = source.width;
    picture->height = source.height;
    picture->divider = source.divider;
    picture->samples = source.samples;
    picture->rendered_seconds = source.seconds;
    picture->quality = quality;
    picture->denoised = std::move(denoised);
    return picture;
}

double energy_change_percent(const Denoised& denoised) {
    return denoised.mean_before > 0 ? 100 * (denoised.mean_after / denoised.mean_before - 1) : 0;
}

std::string_view to_string(DenoiseQuality quality) {
    switch (quality) {
    case DenoiseQuality::fast: return "fast";
    case DenoiseQuality::base: return "base";
    case DenoiseQuality::high: return "high";
    }
    return {};
}

} // namespace blush
