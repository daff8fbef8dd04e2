#include "tests/bench/quality/shown_error.h"

#include "color/exposure_meter.h"
#include "core/math.h"
#include "measure/metrics/image_error.h"
#include "measure/metrics/metrics.h"
#include "ui/views/denoise_view.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace blush::bench {
namespace {

std::span<const float> floats_of(const RgbImage& image) { return {&image.pixels.front().x, 3 * image.pixels.size()}; }

// The two source pixels of a target pixel along one axis.
struct Neighbours {
    int low = 0, high = 0;
    float weight = 0; // of the higher one
};
Neighbours neighbours(int target, int target_size, int source_size) {
    const float at = (float(target) + 0.5f) * float(source_size) / float(target_size) - 0.5f, low = std::floor(at);
    return {std::max(int(low), 0), std::min(int(low) + 1, source_size - 1), at - low};
}

} // namespace

RgbImage enlarged(const RgbImage& image, int width, int height) {
    if (image.width == width && image.height == height) return image;
    RgbImage result{width, height, {}};
    result.pixels.reserve(size_t(width) * size_t(height));
    const auto pixel = [&](int x, int y) { return image.pixels[size_t(y) * size_t(image.width) + size_t(x)]; };
    for (int j = 0; j < height; ++j) {
        const Neighbours y = neighbours(j, height, image.height);
        for (int i = 0; i < width; ++i) {
            const Neighbours x = neighbours(i, width, image.width);
            const auto row = [&](int at) { return pixel(x.low, at) * (1 - x.weight) + pixel(x.high, at) * x.weight; };
            result.pixels.push_back(row(y.low) * (1 - y.weight) + row(y.high) * y.weight);
        }
    }
    return result;
}

ErrorMeter::ErrorMeter(const ColorManagement& color, MeasuredImage reference)
    : color_(color), reference_(std::move(reference)), exposure_ev_(average_exposure(floats_of(reference_.image), 3)),
      displayed_reference_(displayed(reference_.image)) {}

RgbImage ErrorMeter::displayed(RgbImage image) const {
    const auto applied = color_.apply_display({}, {.exposure_ev = exposure_ev_}, &image.pixels.front().x, image.pixels.size());
    if (!applied) throw std::runtime_error(applied.error().text());
    return image;
}

ShownError ErrorMeter::of(const Images& images, bool denoised) const {
    const Frame& frame = *images.frame;
    // As the display pass draws it with a GPU.
    if (denoised && images.denoised && (images.denoised->width > frame.width || images.denoised->has_history())) {
        const auto& [width, height, rgb] = images.denoised->displayed();
        RgbImage shown{width, height, {}};

        for (size_t i = 0; i < rgb.size(); i += 3) shown.pixels.push_back({rgb[i], rgb[i + 1], rgb[i + 2]});
        return of(shown);
    }
    const DenoiseView view{.show = denoised ? DenoiseView::Show::denoised : DenoiseView::Show::raw};
    const std::vector<float> rgb = mixed_image(frame, images.denoised.get(), mix_of(view, images.denoised != nullptr));
    RgbImage shown{frame.width, frame.height, {}};
    for (size_t i = 0; i < rgb.size(); i += 3) shown.pixels.push_back({rgb[i], rgb[i + 1], rgb[i + 2]});

    return of(shown);
}

ShownError ErrorMeter::of(const RgbImage& shown) const {
    const int width = reference_.image.width, height = reference_.image.height;
    const auto compared = compare(enlarged(displayed(shown), width, height), displayed_reference_, Encoding::display);
    if (!compared) throw std::runtime_error(compared.error().text());
    return {compared->flip.mean, error_against({floats_of(enlarged(shown, width, height)), 3}, reference_).relmse.value};
}

double ErrorMeter::reference_relmse() const {
    double sum = 0;
    for (size_t i = 0; i < reference_.error.size(); ++i) {
        const Vec3 &e = reference_.error[i], &r = reference_.image.pixels[i];
        for (const auto channel : {&Vec3::x, &Vec3::y, &Vec3::z})
            sum += double(e.*channel) * double(e.*channel) / (double(r.*channel) * double(r.*channel) + 0.01);
    }
    return sum / (3 * double(std::max<size_t>(1, reference_.error.size())));
}

} // namespace blush::bench
