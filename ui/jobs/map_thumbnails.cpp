#include "ui/jobs/map_thumbnails.h"

#include "ui/gl/texture_id.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr int max_samples = 8; // source pixels averaged per thumbnail pixel, per axis

float value_at(const Image& image, int x, int y, int channel) {
    const size_t i = (size_t(y) * size_t(image.width) + size_t(x)) * size_t(image.channels) + size_t(image.channels < 3 ? 0 : channel);
    const float value = image.floats.empty() ? float(image.bytes[i]) : image.floats[i] * 255;
    return std::isfinite(value) ? std::clamp(value, 0.f, 255.f) : 0.f;
}

} // namespace

SmallImage small_image(const Image& image) {
    const size_t values = size_t(std::max(image.width, 0)) * size_t(std::max(image.height, 0)) * size_t(std::max(image.channels, 0));
    if (values == 0 || std::max(image.bytes.size(), image.floats.size()) < values) return {};
    const double shrink = std::max(1.0, double(std::max(image.width, image.height)) / map_preview_side);
    SmallImage small{std::max(1, int(image.width / shrink)), std::max(1, int(image.height / shrink)), {}};
    small.rgb.reserve(size_t(small.width) * size_t(small.height) * 3);
    const int samples = std::clamp(int(std::ceil(shrink)), 1, max_samples);
    const auto place = [&](int pixel, int sample, int count, int of) {
        return std::min(int((pixel + (sample + 0.5) / samples) * of / count), of - 1);
    };
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x)
            for (int channel = 0; channel < 3; ++channel) {
                float sum = 0;
                for (int j = 0; j < samples; ++j)
                    for (int i = 0; i < samples; ++i)
                        sum += value_at(image, place(x, i, small.width, image.width), place(y, j, small.height, image.height), channel);
                small.rgb.push_back(uint8_t(std::lround(sum / float(samples * samples))));
            }
    return small;
}

MapThumbnails::MapPreview MapThumbnails::of(const Image& image) {
    if (kept_.size() >= most && !kept_.contains(image.serial)) kept_.clear();
    const auto [entry, is_new] = kept_.try_emplace(image.serial);
    Kept& kept = entry->second;
    if (is_new) {
        const SmallImage small = small_image(image);
        if (!small.rgb.empty()) {
            kept = {GlTexture::create(), small.width, small.height};
            glBindTexture(GL_TEXTURE_2D, kept.texture.name());
            glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
            glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, small.width, small.height, 0, GL_RGB, GL_UNSIGNED_BYTE, small.rgb.data());
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
            glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        }
    }
    return {kept.texture ? texture_id(kept.texture.name()) : nullptr, float(kept.width), float(kept.height)};
}

} // namespace blush
