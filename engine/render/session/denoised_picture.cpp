#include "render/session/denoised_picture.h"

#include "core/math.h"
#include "render/light_mix/light_mix.h"

#include <algorithm>
#include <utility>

namespace blush {
namespace {

PixelView view_of(const std::vector<Vec3>& plane) { return {span_of(plane), 3}; }

DenoisedPicture picture_of(const Frame& source, DenoiseQuality quality) {
    DenoisedPicture picture;
    picture.revision = source.revision;
    picture.width = source.width;
    picture.height = source.height;
    picture.divider = source.divider;
    picture.samples = source.samples;
    picture.rendered_seconds = source.seconds;
    picture.quality = quality;
    return picture;
}

double mean_luminance(const std::vector<float>& pixels, size_t stride) {
    double sum = 0;
    for (size_t i = 0; i < pixels.size(); i += stride) sum += double(luminance(Vec3{pixels[i], pixels[i + 1], pixels[i + 2]}));
    return sum / double(std::max<size_t>(1, pixels.size() / stride));
}

} // namespace

std::vector<DenoiseInput> denoise_inputs(const Frame& frame) {
    const DenoiseInput whole{frame.width, frame.height, {frame.rgba, 4}, view_of(frame.albedo), view_of(frame.normal)};
    if (frame.groups.empty()) return {whole};
    std::vector<DenoiseInput> inputs(frame.groups.size(), whole);
    for (size_t k = 0; k < inputs.size(); ++k) inputs[k].color = view_of(frame.groups[k]);
    return inputs;
}

DenoisedPtr denoised_picture(const Frame& source, DenoiseQuality quality, std::vector<Denoised> denoised) {
    auto picture = std::make_shared<DenoisedPicture>(picture_of(source, quality));
    if (source.groups.empty()) {
        picture->denoised = std::move(denoised.front());
        return picture;
    }
    auto planes = std::make_shared<DenoisedGroups>();
    planes->of = source.light_groups;
    Denoised& all = picture->denoised;
    all.network = denoised.front().network;
    all.precision = denoised.front().precision;
    all.exposure_scale = denoised.front().exposure_scale;
    for (Denoised& group : denoised) {
        all.sanitised += group.sanitised;
        all.tiles = std::max(all.tiles, group.tiles);
        all.seconds += group.seconds;
        planes->planes.push_back(std::move(group.rgb));
    }
    picture->groups = std::move(planes);
    picture->gains = source.gains;
    all.rgb = mixed_rgb(*picture, source.gains);
    all.mean_before = mean_luminance(source.rgba, 4);
    all.mean_after = mean_luminance(all.rgb, 3);
    return picture;
}

DenoisedPtr remixed(const DenoisedPicture& picture, const Gains& gains) {
    auto mixed = std::make_shared<DenoisedPicture>(picture);
    mixed->gains = gains;
    mixed->denoised.rgb = mixed_rgb(picture, gains);
    return mixed;
}

std::vector<PlaneSpan> planes_of(const DenoisedPicture& picture) { return {picture.groups->planes.begin(), picture.groups->planes.end()}; }

std::vector<float> mixed_rgb(const DenoisedPicture& picture, std::span<const Vec3> gains, const Workers* workers) {
    std::vector<float> rgb(size_t(picture.width) * size_t(picture.height) * 3);
    mix_rgb(planes_of(picture), gains, rgb, workers);
    return rgb;
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
