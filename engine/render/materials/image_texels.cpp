#include "render/materials/image_texels.h"

#include "core/box_filter.h"
#include "core/half.h"
#include "core/srgb.h"
#include "render/materials/texture_mips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace blush {
namespace {

// Linear values of the 256 bytes.
using ByteValues = std::array<float, 256>;
const ByteValues& srgb_table() {
    static const ByteValues table = [] {
        ByteValues t;
        for (int i = 0; i < 256; ++i) t[size_t(i)] = float(linear_from_srgb(i / 255.0));
        return t;
    }();
    return table;
}
const ByteValues& linear_table() {
    static const ByteValues table = [] {
        ByteValues t;
        for (int i = 0; i < 256; ++i) t[size_t(i)] = float(i) / 255;
        return t;
    }();
    return table;
}

size_t texel_count(const Image& image) { return size_t(image.width) * size_t(image.height); }

// A texel has no alpha if its image has none.
int texel_channels(const Image& image) { return image.channels % 2 == 0 ? 4 : 3; }

size_t mip_texels(const Image& image) {
    size_t texels = 0;
    for (int i = 1; i < mip_count(image.width, image.height); ++i)
        texels += size_t(halved(image.width, i)) * size_t(halved(image.height, i));
    return texels;
}

// A single texel of three bytes would be less than a word, which is what the kernel reads.
bool bytes_are_usable(const Image& image) { return image.channels >= 3 && image.bytes.size() >= 4; }

bool is_usable(float value) { return value >= 0 && std::isfinite(value); }

// Converts a texel with 1 to 4 channels to RGBA.
template <class T> std::array<T, 4> expand(const T* texel, int channels, T opaque) {
    switch (channels) {
    case 1: return {texel[0], texel[0], texel[0], opaque};
    case 2: return {texel[0], texel[0], texel[0], texel[1]};
    case 3: return {texel[0], texel[1], texel[2], opaque};
    default: return {texel[0], texel[1], texel[2], texel[3]};
    }
}

class TexelBuilder {
public:
    TexelBuilder(ImagePtr image, bool is_color)
        : image_(*image), is_color_(is_color), is_float_(image_.bytes.empty()), channels_(size_t(texel_channels(image_))) {
        texels_.image = std::move(image);
        texels_.is_color = is_color;
    }

    ImageTexelsPtr build() && {
        if (is_float_) {
            add_floats();
            add_mips<float>(texels_.mip_floats, encoding_float32, [](float v) { return v; });
        } else {
            add_bytes();
            add_mips<uint16_t>(texels_.mip_halves, encoding_half, [](float v) { return uint16_t(half_bits(v)); });
        }
        return std::make_shared<const ImageTexels>(std::move(texels_));
    }

private:
    void add_level(const void* texels, int i, TextureEncoding encoding, size_t channels) {
        texels_.levels.push_back({texels, halved(image_.width, i), halved(image_.height, i), encoding, int32_t(channels)});
    }

    void add_bytes() {
        const TextureEncoding encoding = is_color_ ? encoding_srgb8 : encoding_linear8;
        const size_t texels = texel_count(image_), from = size_t(image_.channels), to = texels == 1 ? 4 : channels_;
        if (bytes_are_usable(image_)) return add_level(image_.bytes.data(), 0, encoding, from);
        texels_.bytes.resize(texels * to);
        for (size_t i = 0; i < texels; ++i)
            std::copy_n(expand<uint8_t>(&image_.bytes[i * from], image_.channels, 255).begin(), to, &texels_.bytes[i * to]);
        add_level(texels_.bytes.data(), 0, encoding, to);
    }

    void add_floats() {
        const std::vector<float>& values = image_.floats;
        const size_t from = size_t(image_.channels), to = channels_;
        const bool is_encoded = is_color_ && std::ranges::all_of(values, [](float v) { return !(v > 1); });
        texels_.replaced = std::ranges::count_if(values, [](float v) { return !is_usable(v); });
        if (texels_.replaced == 0 && !is_encoded && from >= 3) return add_level(values.data(), 0, encoding_float32, from);
        texels_.floats.resize(texel_count(image_) * to);
        for (size_t i = 0; i < texel_count(image_); ++i) {
            std::array<float, 4> c = expand<float>(&values[i * from], image_.channels, 1);
            for (size_t k = 0; k < 4; ++k) {
                if (!is_usable(c[k])) c[k] = 0;
                if (is_encoded && k < 3) c[k] = float(linear_from_srgb(double(c[k])));
            }
            std::copy_n(c.begin(), to, &texels_.floats[i * to]);
        }
        add_level(texels_.floats.data(), 0, encoding_float32, to);
    }

    // Each channel as stored(linear value).
    template <class T> void add_mips(UnsetVector<T>& values, TextureEncoding encoding, T (*stored)(float)) {
        values.resize(mip_texels(image_) * channels_);
        std::vector<T*> levels;
        T* next = values.data();
        for (int i = 1; i < mip_count(image_.width, image_.height); ++i) {
            levels.push_back(next);
            add_level(next, i, encoding, channels_);
            next += size_t(halved(image_.width, i)) * size_t(halved(image_.height, i)) * channels_;
        }
        const auto read = [&](int y, float* rgba) { is_float_ ? read_floats(y, rgba) : read_bytes(y, rgba); };
        make_mips(image_.width, image_.height, read, [&](int level, int y, std::span<const float> rgba) {
            T* out = levels[size_t(level) - 1] + size_t(y) * (rgba.size() / 4) * channels_;
            for (size_t i = 0; i < rgba.size(); i += 4)
                for (size_t c = 0; c < channels_; ++c) *out++ = stored(rgba[i + c]);
        });
    }

    // Row y of the image in linear RGBA.
    void read_bytes(int y, float* rgba) const {
        const size_t row = size_t(image_.width) * size_t(image_.channels);
        const uint8_t* texel = &image_.bytes[size_t(y) * row];
        const ByteValues &color = is_color_ ? srgb_table() : linear_table(), &alpha = linear_table();
        for (int x = 0; x < image_.width; ++x, texel += image_.channels, rgba += 4) {
            const std::array<uint8_t, 4> c = expand<uint8_t>(texel, image_.channels, 255);
            for (size_t k = 0; k < 3; ++k) rgba[k] = color[c[k]];
            rgba[3] = alpha[c[3]];
        }
    }
    void read_floats(int y, float* rgba) const {
        const TextureLevel& base = texels_.levels.front();
        const float* texel = static_cast<const float*>(base.texels) + size_t(y) * size_t(image_.width) * size_t(base.channels);
        for (int x = 0; x < image_.width; ++x, texel += base.channels, rgba += 4)
            std::ranges::copy(expand<float>(texel, base.channels, 1), rgba);
    }

    const Image& image_;
    bool is_color_, is_float_;
    size_t channels_;
    ImageTexels texels_;
};

} // namespace

bool is_whole(const Image& image) {
    if (image.width < 1 || image.height < 1 || image.channels < 1 || image.channels > 4) return false;
    if (int64_t(image.width) * image.height > max_texels) return false;
    const size_t values = texel_count(image) * size_t(image.channels);
    return (image.bytes.size() == values && image.floats.empty()) || (image.floats.size() == values && image.bytes.empty());
}

ImageTexelsPtr image_texels(ImagePtr image, bool is_color) { return TexelBuilder(std::move(image), is_color).build(); }

int64_t texel_bytes(const Image& image) {
    return int64_t(mip_texels(image)) * texel_channels(image) * int64_t(image.bytes.empty() ? sizeof(float) : sizeof(uint16_t));
}

const float* srgb_byte_values() { return srgb_table().data(); }

} // namespace blush
