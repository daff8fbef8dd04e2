#include "ui/views/denoise_view.h"

#include "core/math.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace blush {

ImageMix mix_of(const DenoiseView& view, bool has_denoised) {
    if (!has_denoised) return {};
    switch (view.show) {
    case DenoiseView::Show::raw: return {1, 0};
    case DenoiseView::Show::denoised: return {0, 1};
    case DenoiseView::Show::blend: return {1 - view.blend, view.blend};
    case DenoiseView::Show::difference: return {1, -1};
    }
    return {};
}

Vec3 denoised_pixel(const Frame& frame, const DenoisedImage& denoised, int x, int y) {
    // Centre of the frame's pixel in the coarser image, computed as in the display pass.
    const auto in_coarse = [](int i, int fine, int coarse) {
        return std::min(int((float(i) + 0.5f) * (float(coarse) / float(fine))), coarse - 1);
    };
    const size_t row = size_t(in_coarse(y, frame.height, denoised.height)), column = size_t(in_coarse(x, frame.width, denoised.width));
    const float* rgb = &denoised.denoised.rgb[3 * (row * size_t(denoised.width) + column)];
    return {rgb[0], rgb[1], rgb[2]};
}

Vec3 mixed_pixel(const Frame& frame, const DenoisedImage* denoised, const ImageMix& mix, int x, int y) {
    const float* rgba = &frame.rgba[4 * (size_t(y) * size_t(frame.width) + size_t(x))];
    Vec3 c = Vec3{rgba[0], rgba[1], rgba[2]} * mix.raw_weight;
    if (denoised && mix.denoised_weight != 0) c = c + denoised_pixel(frame, *denoised, x, y) * mix.denoised_weight;
    return {std::abs(c.x), std::abs(c.y), std::abs(c.z)};
}

std::vector<float> mixed_image(const Frame& frame, const DenoisedImage* denoised, const ImageMix& mix) {
    std::vector<float> rgb(frame.rgba.size() / 4 * 3);
    float* to = rgb.data();
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            const Vec3 c = mixed_pixel(frame, denoised, mix, x, y);
            *to++ = c.x;
            *to++ = c.y;
            *to++ = c.z;
        }
    return rgb;
}

std::string shown_text(const DenoiseView& view, const Frame& frame, const DenoisedImage* denoised) {
    if (!view.wants_denoised()) return "raw";
    if (!denoised) return "raw, denoising";
    std::string text = view.show == DenoiseView::Show::denoised ? "denoised"
                       : view.show == DenoiseView::Show::blend  ? fmt::format("blend {:.0f} %", 100 * view.blend)
                                                                : "difference";
    const std::string edges =
        std::string(denoised->is_enlarged ? ", edges sharpened" : "") +
        (denoised->has_history() ? fmt::format(", {:.0f} % of the view before", 100 * denoised->with_history.share) : "");
    if (denoised->divider != frame.divider) return text + fmt::format(" of 1/{} size{}", denoised->divider, edges);
    // The complete image gets the high quality after a while: until then the displayed one changes by itself.
    if (denoised->quality != DenoiseQuality::high) text += fmt::format(", {} quality", to_string(denoised->quality));
    text += edges;
    const int64_t samples = frame.samples - denoised->samples;
    if (samples > 0)
        text += fmt::format(", {} spp and {:.1f} s behind", samples, std::max(0.0, frame.seconds - denoised->rendered_seconds));
    return text;
}

} // namespace blush
