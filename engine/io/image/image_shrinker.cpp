#include "io/image/image_shrinker.h"

#include "core/box_filter.h"
#include "core/srgb.h"

#include <algorithm>
#include <utility>

namespace blush {

ImageShrinker::ImageShrinker(const Source& source, int halvings) : source_(source) {
    image_.width = halved(source.width, halvings);
    image_.height = halved(source.height, halvings);
    image_.channels = source.channels;
    const size_t row = size_t(image_.width) * size_t(image_.channels);
    across_.resize(row);
    now_.resize(row);
    next_.resize(row);
    if (source.is_float)
        image_.floats.reserve(row * size_t(image_.height));
    else
        image_.bytes.reserve(row * size_t(image_.height));
    for (int i = 0; i < 256; ++i) {
        const float encoded = float(i) / 255;
        byte_values_[size_t(i)] = source.is_srgb ? linear_from_srgb(encoded) : encoded;
    }
}

void ImageShrinker::add(std::span<const uint8_t> rows) { add_rows(rows); }
void ImageShrinker::add(std::span<const float> rows) { add_rows(rows); }

template <class T> void ImageShrinker::add_rows(std::span<const T> rows) {
    const size_t row = size_t(source_.width) * size_t(source_.channels);
    for (size_t i = 0; i + row <= rows.size(); i += row) add_row(rows.data() + i);
}

template <class T> void ImageShrinker::add_row(const T* row) {
    const auto value = [&](T v, int channel) {
        if constexpr (std::is_same_v<T, uint8_t>)
            return is_color(channel) ? byte_values_[v] : float(v) / 255;
        else
            return source_.is_srgb && is_color(channel) ? linear_from_srgb(v) : v;
    };
    const int channels = source_.channels;
    std::ranges::fill(across_, 0.f);
    for (int x = 0; x < image_.width; ++x)
        for_each_box_weight(x, source_.width, image_.width, [&](int from, float share) {
            for (int c = 0; c < channels; ++c)
                across_[size_t(x * channels + c)] += share * value(row[size_t(from) * size_t(channels) + size_t(c)], c);
        });
    const int current = int(int64_t(rows_) * image_.height / source_.height);
    const float size = float(double(image_.height) / source_.height); // height of a source row in result rows
    for_each_box_weight(rows_, image_.height, source_.height, [&](int y, float share) {
        std::vector<float>& sums = y == current ? now_ : next_;
        for (size_t i = 0; i < sums.size(); ++i) sums[i] += share * size * across_[i];
    });
    ++rows_;
    if (int64_t(rows_) * image_.height >= int64_t(current + 1) * source_.height) finish_row();
}

void ImageShrinker::finish_row() {
    for (size_t i = 0; i < now_.size(); ++i) {
        const bool encode = source_.is_srgb && is_color(int(i % size_t(source_.channels)));
        const float v = encode ? srgb_from_linear(now_[i]) : now_[i];
        if (source_.is_float)
            image_.floats.push_back(v);
        else
            image_.bytes.push_back(uint8_t(std::clamp(v, 0.f, 1.f) * 255 + 0.5f));
    }
    std::swap(now_, next_);
    std::ranges::fill(next_, 0.f);
}

ImagePtr ImageShrinker::image() && { return std::make_shared<const Image>(std::move(image_)); }

} // namespace blush
