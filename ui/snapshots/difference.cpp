#include "ui/snapshots/difference.h"

#include "measure/metrics/flip.h"
#include "ui/snapshots/heat_map.h"

#include <cmath>
#include <exception>
#include <fmt/format.h>

namespace blush {
namespace {

RgbImage seen(const Frame& frame, const DenoisedImage* denoised, const DenoiseView& view) {
    RgbImage image{frame.width, frame.height, {}};
    image.pixels.reserve(frame.rgba.size() / 4);
    const ImageMix mix = mix_of(view, denoised != nullptr);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) image.pixels.push_back(mixed_pixel(frame, denoised, mix, x, y));
    return image;
}

float relative(const Vec3& a, const Vec3& b) {
    const auto channel = [](float p, float q) { return std::abs(p - q) / std::sqrt(q * q + 0.01f); };
    return (channel(a.x, b.x) + channel(a.y, b.y) + channel(a.z, b.z)) / 3;
}

Vec3 distance(const Vec3& a, const Vec3& b) { return {std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)}; }

void paint(Difference& d, const RgbImage& a, const RgbImage& b) {
    const std::vector<float> flip = d.kind == DifferenceKind::flip ? hdr_flip(b, a) : std::vector<float>();
    d.rgba.assign(4 * a.pixels.size(), 1.f);
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const Vec3 c = d.kind == DifferenceKind::absolute
                           ? distance(a.pixels[i], b.pixels[i])
                           : heat_map_color(d.kind == DifferenceKind::flip ? flip[i] : relative(a.pixels[i], b.pixels[i]));
        d.rgba[4 * i] = c.x;
        d.rgba[4 * i + 1] = c.y;
        d.rgba[4 * i + 2] = c.z;
    }
}

} // namespace

Difference difference_of(const DifferenceInput& q) {
    Difference d{.kind = q.kind};
    const Frame &a = *q.a, &b = *q.b;
    if (a.width != b.width || a.height != b.height) {
        d.problem = fmt::format("A has {} × {} pixels, B {} × {}. Only images of the same size can be compared.", a.width, a.height,
                                b.width, b.height);
        return d;
    }
    try {
        const RgbImage image_a = seen(a, q.denoised_a.get(), q.view), image_b = seen(b, q.denoised_b.get(), q.view);
        d.has_flip = q.kind == DifferenceKind::flip;
        const Result<Metrics> numbers = compare(image_a, image_b, Encoding::scene_linear, d.has_flip);
        if (!numbers) {
            d.problem = numbers.error().text();
            return d;
        }
        d.numbers = *numbers;
        d.width = a.width;
        d.height = a.height;
        paint(d, image_a, image_b);
    } catch (const std::exception& e) { d.problem = e.what(); }
    return d;
}

std::string caption_of(DifferenceKind kind) {
    switch (kind) {
    case DifferenceKind::absolute: return "|A - B|, through the view and exposure";
    case DifferenceKind::relative: return "|A - B| / B: black 0, white 1";
    case DifferenceKind::flip: return "FLIP, perceived difference: black 0, white 1";
    }
    return {};
}

} // namespace blush
