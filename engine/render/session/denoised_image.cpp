#include "render/session/denoised_image.h"

#include "core/math.h"
#include "render/denoise/bias_correction.h"
#include "render/denoise/joint_upsampling.h"
#include "render/light_mix/light_mix.h"

#include <algorithm>
#include <utility>

namespace blush {
namespace {

PixelView view_of(const std::vector<Vec3>& plane) { return {span_of(plane), 3}; }

DenoisedImage image_of(const Frame& source, DenoiseQuality quality) {
    DenoisedImage image;
    image.revision = source.revision;
    image.is_enlarged = source.first_hits != nullptr;
    image.width = image.is_enlarged ? source.first_hits->width : source.width;
    image.height = image.is_enlarged ? source.first_hits->height : source.height;
    image.divider = source.divider;
    image.samples = source.samples;
    image.rendered_seconds = source.seconds;
    image.quality = quality;
    return image;
}

double mean_luminance(const std::vector<float>& pixels, size_t stride) {
    double sum = 0;
    for (size_t i = 0; i < pixels.size(); i += stride) sum += double(luminance(Vec3{pixels[i], pixels[i + 1], pixels[i + 2]}));
    return sum / double(std::max<size_t>(1, pixels.size() / stride));
}

void correct_biases(const Frame& source, std::vector<Denoised>& denoised, const Workers* workers) {
    if (source.half_difference.empty()) return;
    const std::vector<DenoiseInput> inputs = denoise_inputs(source);
    for (size_t k = 0; k < denoised.size(); ++k) {
        const std::vector<Vec3>& halves = source.groups.empty() ? source.half_difference : source.group_half_differences[k];
        correct_bias_of(denoised[k], inputs[k], halves, workers);
    }
}

} // namespace

std::vector<DenoiseInput> denoise_inputs(const Frame& frame) {
    const DenoiseInput whole{frame.width, frame.height, {frame.rgba, 4}, view_of(frame.albedo), view_of(frame.normal)};
    if (frame.groups.empty()) return {whole};
    std::vector<DenoiseInput> inputs(frame.groups.size(), whole);
    for (size_t k = 0; k < inputs.size(); ++k) inputs[k].color = view_of(frame.groups[k]);
    return inputs;
}

void correct_bias_of(Denoised& denoised, const DenoiseInput& input, std::span<const Vec3> half_difference, const Workers* workers) {
    correct_bias(denoised.rgb, input.color, half_difference, input.width, input.height, denoised.exposure_scale, workers);
    denoised.mean_after = mean_luminance(denoised.rgb, 3);
    denoised.bias_corrected = true;
}

std::shared_ptr<DenoisedImage> denoised_image(const Frame& source, DenoiseQuality quality, std::vector<Denoised> denoised,
                                              const Workers* workers) {
    correct_biases(source, denoised, workers);
    if (source.first_hits) {
        const FirstHitPlanes coarse{source.width, source.height, source.albedo, source.normal, source.depth, {}};
        for (Denoised& d : denoised) d.rgb = upsample_jointly(d.rgb, coarse, *source.first_hits, workers);
    }
    auto image = std::make_shared<DenoisedImage>(image_of(source, quality));
    if (source.groups.empty()) {
        image->denoised = std::move(denoised.front());
        return image;
    }
    auto planes = std::make_shared<DenoisedGroups>();
    planes->of = source.light_groups;
    Denoised& all = image->denoised;
    all.network = denoised.front().network;
    all.precision = denoised.front().precision;
    all.exposure_scale = denoised.front().exposure_scale;
    all.bias_corrected = denoised.front().bias_corrected;
    for (Denoised& group : denoised) {
        all.sanitised += group.sanitised;
        all.tiles = std::max(all.tiles, group.tiles);
        all.seconds += group.seconds;
        planes->planes.push_back(std::move(group.rgb));
    }
    image->groups = std::move(planes);
    image->gains = source.gains;
    all.rgb = mixed_rgb(*image, source.gains);
    all.mean_before = mean_luminance(source.rgba, 4);
    all.mean_after = mean_luminance(all.rgb, 3);
    return image;
}

DenoisedPtr remixed(const DenoisedImage& image, const Gains& gains) {
    auto mixed = std::make_shared<DenoisedImage>(image);
    mixed->gains = gains;
    mixed->denoised.rgb = mixed_rgb(image, gains);
    return mixed;
}

DenoisedPtr without_history(const DenoisedImage& image) {
    auto plain = std::make_shared<DenoisedImage>(image);
    plain->with_history = {};
    return plain;
}

std::vector<PlaneSpan> planes_of(const DenoisedImage& image) { return {image.groups->planes.begin(), image.groups->planes.end()}; }

std::vector<float> mixed_rgb(const DenoisedImage& image, std::span<const Vec3> gains, const Workers* workers) {
    std::vector<float> rgb(size_t(image.width) * size_t(image.height) * 3);
    mix_rgb(planes_of(image), gains, rgb, workers);
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
