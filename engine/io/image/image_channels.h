// Converts grey images to RGB, so that every image has a colour and a G channel.
#pragma once

#include "scene/scene.h"

namespace blush {

// Returns the image itself if it has 3 or 4 channels; else grey copied to R, G and B, with alpha kept.
inline ImagePtr with_color_channels(const ImagePtr& image) {
    if (image->channels >= 3) return image;
    auto spread_image = std::make_shared<Image>();
    spread_image->width = image->width;
    spread_image->height = image->height;
    spread_image->channels = image->channels == 2 ? 4 : 3;
    const size_t from = size_t(image->channels), to = size_t(spread_image->channels);
    const auto spread = [&](const auto& values) {
        auto result = values;
        result.resize(values.size() / from * to);
        for (size_t i = 0; i < values.size() / from; ++i)
            for (size_t c = 0; c < to; ++c) result[i * to + c] = values[i * from + (c == 3 ? 1 : 0)];
        return result;
    };
    spread_image->bytes = spread(image->bytes);
    spread_image->floats = spread(image->floats);
    return spread_image;
}

} // namespace blush
