#include "render/texture_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace blush {
namespace {

constexpr size_t max_byte_texels = (size_t(1) << 31) - 1, max_float_texels = (size_t(1) << 29) - 1; // indices are 32-bit

// IEC 61966-2-1.
double srgb_to_linear(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

const std::array<float, 256>& srgb_table() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t;
        for (int i = 0; i < 256; ++i) t[size_t(i)] = float(srgb_to_linear(i / 255.0));
        return t;
    }();
    return table;
}

size_t texel_count(const Image& image) { return size_t(image.width) * size_t(image.height); }

bool is_whole(const Image* image) {
    if (!image || image->width < 1 || image->height < 1 || image->channels < 1 || image->channels > 4) return false;
    const size_t values = texel_count(*image) * size_t(image->channels);
    return (image->bytes.size() == values && image->floats.empty()) || (image->floats.size() == values && image->bytes.empty());
}

// Texel of an image with 1 to 4 channels as RGBA.
template <class T> std::array<T, 4> expand(const T* texel, int channels, T opaque) {
    switch (channels) {
    case 1: return {texel[0], texel[0], texel[0], opaque};
    case 2: return {texel[0], texel[0], texel[0], texel[1]};
    case 3: return {texel[0], texel[1], texel[2], opaque};
    default: return {texel[0], texel[1], texel[2], texel[3]};
    }
}

void append_bytes(std::vector<uint32_t>& pool, const Image& image) {
    const size_t channels = size_t(image.channels);
    for (size_t i = 0; i < texel_count(image); ++i) {
        const std::array<uint8_t, 4> c = expand<uint8_t>(&image.bytes[i * channels], image.channels, 255);
        pool.push_back(c[0] | uint32_t(c[1]) << 8 | uint32_t(c[2]) << 16 | uint32_t(c[3]) << 24);
    }
}

// Returns how many values had to be replaced.
int64_t append_floats(std::vector<float>& pool, const Image& image, bool is_color) {
    const bool is_encoded = is_color && std::ranges::all_of(image.floats, [](float v) { return !(v > 1); });
    const size_t channels = size_t(image.channels);
    int64_t replaced = 0;
    for (size_t i = 0; i < texel_count(image); ++i) {
        std::array<float, 4> c = expand<float>(&image.floats[i * channels], image.channels, 1);
        for (size_t k = 0; k < 4; ++k) {
            const bool is_usable = c[k] >= 0 && std::isfinite(c[k]);
            replaced += !is_usable && k < channels;
            if (!is_usable) c[k] = 0;
            if (is_encoded && k < 3) c[k] = float(srgb_to_linear(c[k]));
        }
        pool.insert(pool.end(), c.begin(), c.end());
    }
    return replaced;
}

class Builder {
public:
    explicit Builder(std::vector<TextureSource> sources) { table_.sources = std::move(sources); }

    TextureTable build() && {
        reserve();
        for (const TextureSource& source : table_.sources) table_.records.push_back(record(source));
        return std::move(table_);
    }

private:
    struct Place {
        int32_t offset;
        TextureEncoding encoding;
    };

    // Room for exactly what is appended.
    void reserve() {
        std::set<std::pair<uint64_t, bool>> images; // as offsets_ has them
        size_t bytes = 0, floats = 0;
        for (const TextureSource& source : table_.sources) {
            const Image* image = source.image.get();
            if (!is_whole(image)) continue;
            const bool is_float = image->bytes.empty();
            if (images.emplace(image->serial, is_float && source.is_color).second) (is_float ? floats : bytes) += texel_count(*image);
        }
        table_.rgba8.reserve(std::min(bytes, max_byte_texels));
        table_.rgba32f.reserve(4 * std::min(floats, max_float_texels));
    }

    TextureRecord record(const TextureSource& source) {
        const Image* image = source.image.get();
        if (!is_whole(image)) {
            warn(source, "image does not hold width x height pixels of 1 to 4 channels: read as white");
            image = white_.get();
        } else if (!fits(*image)) {
            warn(source, "textures exceed what the renderer can address: read as white");
            image = white_.get();
        }
        const Place place = place_of(*image, source);
        return {.offset = place.offset,
                .width = image->width,
                .height = image->height,
                .wrap_u = wrap(source.wrap_u),
                .wrap_v = wrap(source.wrap_v),
                .filter = source.filter == Texture::Filter::nearest ? filter_nearest : filter_linear,
                .encoding = place.encoding};
    }

    Place place_of(const Image& image, const TextureSource& source) {
        const bool is_float = image.bytes.empty();
        // Bytes are the same texels for colour and for data.
        const auto [it, is_new] = offsets_.try_emplace({image.serial, is_float && source.is_color}, 0);
        if (is_new && is_float) {
            it->second = int32_t(table_.rgba32f.size() / 4);
            const int64_t replaced = append_floats(table_.rgba32f, image, source.is_color);
            if (replaced > 0) warn(source, fmt::format("{} values are negative or not finite: read as 0", replaced));
        } else if (is_new) {
            it->second = int32_t(table_.rgba8.size());
            append_bytes(table_.rgba8, image);
        }
        return {it->second, is_float ? encoding_float32 : source.is_color ? encoding_srgb8 : encoding_linear8};
    }

    // One texel of each pool is kept for white.
    bool fits(const Image& image) const {
        const size_t texels = texel_count(image);
        if (image.bytes.empty()) return texels < max_float_texels - table_.rgba32f.size() / 4;
        return texels < max_byte_texels - table_.rgba8.size();
    }

    void warn(const TextureSource& source, std::string what) {
        table_.warnings.push_back({Diagnostic::Severity::warning, std::move(what), fmt::format("texture \"{}\"", source.name)});
    }

    static TextureWrap wrap(Texture::Wrap w) {
        return w == Texture::Wrap::repeat ? wrap_repeat : w == Texture::Wrap::clamp_to_edge ? wrap_clamp : wrap_mirror;
    }

    TextureTable table_;
    std::map<std::pair<uint64_t, bool>, int32_t> offsets_; // by (serial, decoded)
    const ImagePtr white_ = std::make_shared<Image>(Image{.width = 1, .height = 1, .channels = 1, .bytes = {255}, .floats = {}});
};

} // namespace

int32_t TextureTable::index_of(Id<Texture> id, bool is_color) const {
    const auto key = [](const TextureSource& s) { return std::tuple(s.id, s.is_color); };
    const auto it = std::ranges::lower_bound(sources, std::tuple(id, is_color), {}, key);
    return it != sources.end() && key(*it) == std::tuple(id, is_color) ? int32_t(it - sources.begin()) : -1;
}

TextureTables TextureTable::tables() const { return {records.data(), nullptr, rgba8.data(), rgba32f.data(), srgb_table().data()}; }

int64_t texel_bytes(const Image& image) {
    return int64_t(texel_count(image)) * int64_t(image.bytes.empty() ? 4 * sizeof(float) : sizeof(uint32_t));
}

TextureTable build_texture_table(std::vector<TextureSource> sources) {
    const auto begin = std::chrono::steady_clock::now();
    TextureTable table = Builder(std::move(sources)).build();
    table.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return table;
}

} // namespace blush
