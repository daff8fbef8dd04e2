#include "render/materials/texture_table.h"

#include "core/box_filter.h"
#include "core/half.h"
#include "core/parallel.h"
#include "core/srgb.h"
#include "render/materials/texture_mips.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <utility>

namespace blush {
namespace {

// Indices are 32-bit.
constexpr size_t max_byte_texels = (size_t(1) << 31) - 1, max_half_texels = (size_t(1) << 30) - 1, max_float_texels = (size_t(1) << 29) - 1;

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

bool is_whole(const Image* image) {
    if (!image || image->width < 1 || image->height < 1 || image->channels < 1 || image->channels > 4) return false;
    const size_t values = texel_count(*image) * size_t(image->channels);
    return (image->bytes.size() == values && image->floats.empty()) || (image->floats.size() == values && image->bytes.empty());
}

// Converts a texel with 1 to 4 channels to RGBA.
template <class T> std::array<T, 4> expand(const T* texel, int channels, T opaque) {
    switch (channels) {
    case 1: return {texel[0], texel[0], texel[0], opaque};
    case 2: return {texel[0], texel[0], texel[0], texel[1]};
    case 3: return {texel[0], texel[1], texel[2], opaque};
    default: return {texel[0], texel[1], texel[2], texel[3]};
    }
}

size_t mip_texels(const Image& image) {
    size_t texels = 0;
    for (int i = 1; i < mip_count(image.width, image.height); ++i)
        texels += size_t(halved(image.width, i)) * size_t(halved(image.height, i));
    return texels;
}

// Storage of an image read as colour or as data, and the problems found.
struct Placed {
    const TextureSource* source = nullptr; // the first one with this image and encoding
    const Image* image = nullptr;
    size_t base = 0, mips = 0; // offsets in their pools, in texels
    bool owns_base = true;     // else the entry of the other encoding fills in the same bytes
    int32_t first_level = 0;
    int64_t replaced = 0; // invalid values
};

class Builder {
public:
    explicit Builder(std::vector<TextureSource> sources) { table_.sources = std::move(sources); }

    TextureTable build(const Workers* workers) && {
        for (const TextureSource& source : table_.sources) table_.records.push_back(record(source));
        table_.rgba8.resize(bytes_);
        table_.rgba16f.resize(2 * half_floats_);
        table_.rgba32f.resize(4 * floats_);
        const auto fill_one = [&](int64_t i, unsigned) { fill(placed_[size_t(i)]); };
        const auto count = int64_t(placed_.size());
        if (workers)
            workers->for_each(count, {}, fill_one);
        else
            for (int64_t i = 0; i < count; ++i) fill_one(i, 0);
        for (const Placed& placed : placed_)
            if (placed.replaced > 0) warn(*placed.source, fmt::format("{} values are negative or not finite: read as 0", placed.replaced));
        return std::move(table_);
    }

private:
    TextureRecord record(const TextureSource& source) {
        const Image* image = source.image.get();
        if (!is_whole(image)) {
            warn(source, "image does not hold width x height pixels of 1 to 4 channels: read as white");
            image = white_.get();
        } else if (!fits(*image)) {
            warn(source, "textures exceed what the renderer can address: read as white");
            image = white_.get();
        }
        const Placed& placed = place(*image, source);
        return {.first_level = placed.first_level,
                .levels = mip_count(image->width, image->height),
                .wrap_u = wrap(source.wrap_u),
                .wrap_v = wrap(source.wrap_v),
                .filter = source.filter == Texture::Filter::nearest ? filter_nearest : filter_linear};
    }

    const Placed& place(const Image& image, const TextureSource& source) {
        const auto [known, is_new] = places_.try_emplace({image.serial, source.is_color}, placed_.size());
        if (!is_new) return placed_[known->second];
        const bool is_float = image.bytes.empty();
        Placed placed{&source, &image};
        placed.first_level = int32_t(table_.levels.size());
        // 8-bit texels are stored once for colour and data.
        const auto other = places_.find({image.serial, !source.is_color});
        placed.owns_base = is_float || other == places_.end();
        placed.base = placed.owns_base ? take(is_float ? floats_ : bytes_, texel_count(image)) : placed_[other->second].base;
        placed.mips = take(is_float ? floats_ : half_floats_, mip_texels(image));
        size_t offset = placed.mips;
        add_level(placed.base, image.width, image.height,
                  is_float          ? encoding_float32
                  : source.is_color ? encoding_srgb8
                                    : encoding_linear8);
        for (int i = 1; i < mip_count(image.width, image.height); ++i) {
            const int width = halved(image.width, i), height = halved(image.height, i);
            add_level(offset, width, height, is_float ? encoding_float32 : encoding_half);
            offset += size_t(width) * size_t(height);
        }
        placed_.push_back(placed);
        return placed_.back();
    }

    void add_level(size_t offset, int width, int height, TextureEncoding encoding) {
        table_.levels.push_back({int32_t(offset), width, height, encoding});
    }

    static size_t take(size_t& used, size_t count) {
        used += count;
        return used - count;
    }

    // One texel of each pool is reserved for white.
    bool fits(const Image& image) const {
        const size_t texels = texel_count(image), mips = mip_texels(image);
        if (image.bytes.empty()) return texels + mips < max_float_texels - floats_;
        return texels < max_byte_texels - bytes_ && mips <= max_half_texels - half_floats_;
    }

    // Thread-safe: no two entries write the same texels.
    void fill(Placed& placed) {
        const Image& image = *placed.image;
        const size_t row = size_t(image.width);
        if (image.bytes.empty()) fill_floats(placed);
        const auto read = [&](int y, float* rgba) {
            const size_t at = placed.base + size_t(y) * row;
            if (image.bytes.empty()) {
                std::copy_n(table_.rgba32f.data() + 4 * at, 4 * row, rgba);
                return;
            }
            if (placed.owns_base) fill_bytes(image, y, table_.rgba8.data() + at);
            read_bytes(image, y, placed.source->is_color, rgba);
        };
        std::vector<size_t> levels{placed.mips}; // offsets
        for (int i = 1; i < mip_count(image.width, image.height); ++i)
            levels.push_back(levels.back() + size_t(halved(image.width, i)) * size_t(halved(image.height, i)));
        make_mips(image.width, image.height, read, [&](int level, int y, std::span<const float> rgba) {
            const size_t at = levels[size_t(level) - 1] + size_t(y) * rgba.size() / 4;
            if (image.bytes.empty())
                std::ranges::copy(rgba, table_.rgba32f.begin() + std::ptrdiff_t(4 * at));
            else
                fill_half_floats(rgba, table_.rgba16f.data() + 2 * at);
        });
    }

    static const uint8_t* row_of(const Image& image, int y) {
        return &image.bytes[size_t(y) * size_t(image.width) * size_t(image.channels)];
    }

    static void fill_bytes(const Image& image, int y, uint32_t* texels) {
        const uint8_t* texel = row_of(image, y);
        for (int x = 0; x < image.width; ++x, texel += image.channels) {
            const std::array<uint8_t, 4> c = expand<uint8_t>(texel, image.channels, 255);
            texels[x] = c[0] | uint32_t(c[1]) << 8 | uint32_t(c[2]) << 16 | uint32_t(c[3]) << 24;
        }
    }

    static void read_bytes(const Image& image, int y, bool is_color, float* rgba) {
        const uint8_t* texel = row_of(image, y);
        const ByteValues &color = is_color ? srgb_table() : linear_table(), &alpha = linear_table();
        for (int x = 0; x < image.width; ++x, texel += image.channels, rgba += 4) {
            const std::array<uint8_t, 4> c = expand<uint8_t>(texel, image.channels, 255);
            for (size_t k = 0; k < 3; ++k) rgba[k] = color[c[k]];
            rgba[3] = alpha[c[3]];
        }
    }

    static void fill_half_floats(std::span<const float> rgba, uint32_t* pairs) {
        for (size_t i = 0; i < rgba.size() / 2; ++i) pairs[i] = half_bits(rgba[2 * i]) | half_bits(rgba[2 * i + 1]) << 16;
    }

    void fill_floats(Placed& placed) {
        const Image& image = *placed.image;
        const bool is_encoded = placed.source->is_color && std::ranges::all_of(image.floats, [](float v) { return !(v > 1); });
        const size_t channels = size_t(image.channels);
        float* texel = table_.rgba32f.data() + 4 * placed.base;
        for (size_t i = 0; i < texel_count(image); ++i) {
            std::array<float, 4> c = expand<float>(&image.floats[i * channels], image.channels, 1);
            for (size_t k = 0; k < 4; ++k) {
                const bool is_usable = c[k] >= 0 && std::isfinite(c[k]);
                placed.replaced += !is_usable && k < channels;
                if (!is_usable) c[k] = 0;
                if (is_encoded && k < 3) c[k] = float(linear_from_srgb(double(c[k])));
            }
            texel = std::ranges::copy(c, texel).out;
        }
    }

    void warn(const TextureSource& source, std::string what) {
        table_.warnings.push_back({Diagnostic::Severity::warning, std::move(what), fmt::format("texture \"{}\"", source.name)});
    }

    static TextureWrap wrap(Texture::Wrap w) {
        return w == Texture::Wrap::repeat ? wrap_repeat : w == Texture::Wrap::clamp_to_edge ? wrap_clamp : wrap_mirror;
    }

    TextureTable table_;
    std::vector<Placed> placed_;
    std::map<std::pair<uint64_t, bool>, size_t> places_; // by (serial, as colour)
    size_t bytes_ = 0, half_floats_ = 0, floats_ = 0;    // texels of each pool
    const ImagePtr white_ = std::make_shared<Image>(Image{.width = 1, .height = 1, .channels = 1, .bytes = {255}, .floats = {}});
};

} // namespace

int32_t TextureTable::index_of(Id<Texture> id, bool is_color) const {
    const auto key = [](const TextureSource& s) { return std::tuple(s.id, s.is_color); };
    const auto it = std::ranges::lower_bound(sources, std::tuple(id, is_color), {}, key);
    return it != sources.end() && key(*it) == std::tuple(id, is_color) ? int32_t(it - sources.begin()) : -1;
}

float TextureTable::texels_per_unit(int32_t texture) const {
    const TextureLevel& image = levels[size_t(records[size_t(texture)].first_level)];
    return float(std::sqrt(double(image.width) * image.height));
}

TextureTables TextureTable::tables() const {
    return {records.data(), levels.data(), nullptr, rgba8.data(), rgba16f.data(), rgba32f.data(), srgb_table().data()};
}

size_t TextureTable::memory_bytes() const {
    return (rgba8.capacity() + rgba16f.capacity()) * sizeof(uint32_t) + rgba32f.capacity() * sizeof(float);
}

int64_t texel_bytes(const Image& image) {
    const auto base = int64_t(texel_count(image)), mips = int64_t(mip_texels(image));
    return image.bytes.empty() ? (base + mips) * 16 : base * 4 + mips * 8;
}

TextureTable build_texture_table(std::vector<TextureSource> sources, const Workers* workers) {
    const auto begin = std::chrono::steady_clock::now();
    TextureTable table = Builder(std::move(sources)).build(workers);
    table.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return table;
}

} // namespace blush
