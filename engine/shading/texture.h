// Image textures: glTF's wrap modes and filters, and mip levels. They read the texels of the images without a copy.
// Texels are linearised before filtering, as in sRGB samplers of GPUs; filtering encoded values would darken every edge.
#pragma once

#include "core/half.h"
#include "core/lane_pointers.h"
#include "core/math.h"

#include <array>

namespace blush {

enum TextureWrap : int32_t { wrap_repeat, wrap_clamp, wrap_mirror };
enum TextureFilter : int32_t { filter_linear, filter_nearest };
// Type and colour encoding of an image's texels. Alpha is always linear.
enum TextureEncoding : int32_t {
    encoding_srgb8, // bytes, colour sRGB-encoded
    encoding_linear8,
    encoding_half,
    encoding_float32,
};

// One mip level of an image. All values are finite.
struct TextureLevel {
    const void* texels; // top row first, tightly packed; at least four bytes
    int32_t width, height;
    int32_t encoding; // TextureEncoding
    int32_t channels; // 4, or 3: alpha is 1
};

// With this limit 32 bits can count the bytes of an image.
constexpr int64_t max_texels = int64_t(1) << 28;

struct TextureRecord {
    int32_t first_level;    // the image itself; smaller levels follow, each half as wide and high
    int32_t levels;         // at least 1
    int32_t wrap_u, wrap_v; // TextureWrap
    int32_t filter;         // TextureFilter
};

// Maximal number of UV sets that the textures of one scene use.
constexpr int max_uv_sets = 8;

// A texture as used by one material slot: u' = u_from_u * u + u_from_v * v + u_offset, the same for v'.
struct TextureUse {
    int32_t texture; // index of a TextureRecord
    int32_t uv_set;  // index into TexturePoint::uv
    float u_from_u, u_from_v, u_offset;
    float v_from_u, v_from_v, v_offset;
    float texels_per_uv; // of the full image, per unit of length in the UV set: mean over directions
};

struct TextureTables {
    const TextureRecord* textures = nullptr;
    const TextureLevel* levels = nullptr;
    const TextureUse* uses = nullptr;
    const float* srgb_to_linear = nullptr; // of the 256 byte values
    int32_t uv_sets = 0;                   // number of UV sets in the uses
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

template <class F> Vec4T<F> select(const Mask<F>& m, const Vec4T<F>& a, const Vec4T<F>& b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w)};
}
// Returns exactly a for t = 0 and for a = b.
template <class F> Vec4T<F> lerp(const Vec4T<F>& a, const Vec4T<F>& b, const std::type_identity_t<F>& t) {
    return {lerp(a.x, b.x, t), lerp(a.y, b.y, t), lerp(a.z, b.z, t), lerp(a.w, b.w, t)};
}
template <class F> Vec<F> rgb(const Vec4T<F>& c) { return {c.x, c.y, c.z}; }

// Texture coordinates of a surface point.
template <class F> struct TexturePoint {
    // The first TextureTables::uv_sets entries of each are valid.
    std::array<Vec2T<F>, max_uv_sets> uv;
    std::array<F, max_uv_sets> width; // of the footprint, in units of uv; 0: a point
};

// The two texels along one axis around a coordinate, both in [0, size), and the weight of the second.
template <class F> struct TexturePair {
    Int<F> first, second;
    F weight;
};

// `s` in units of the image, any finite number. Texel i covers [i, i + 1] / size; at its centre its weight is 1.
template <class F> TexturePair<F> texture_pair(const F& s, const Int<F>& size, const Int<F>& wrap, const Mask<F>& nearest) {
    const Mask<F> repeats = as_mask(wrap == wrap_repeat), mirrors = as_mask(wrap == wrap_mirror);
    const F in_period = s - 2.f * floor(s * 0.5f); // [0, 2]
    const F mirrored = select(in_period > F(1.f), 2.f - in_period, in_period);
    // In [0, 1], ends included: the rounding of s - floor(s) reaches 1.
    const F t = select(repeats, s - floor(s), select(mirrors, mirrored, clamp01(s)));

    const F x = t * to_float(size) - select(nearest, F(0.f), F(0.5f));
    const F below = floor(x);
    const Int<F> last = size - 1;
    const Int<F> first = to_int(below); // in [-1, size]
    const Int<F> second = first + 1;
    // Repeat continues at the other edge; with mirrored repeat, the neighbour of an edge texel is that texel itself.
    const Int<F> before_first = select(repeats, last, Int<F>(0)), after_last = select(repeats, Int<F>(0), last);
    return {select(as_mask(first < 0), before_first, min(first, last)), select(as_mask(second > last), after_last, second),
            select(nearest, F(0.f), x - below)};
}

template <class F> Vec4T<F> decode_texel(const TextureTables& tables, const UInt<F>& rgba, const Mask<F>& is_srgb) {
    const Int<F> r = to_signed(UInt<F>(rgba & 255u)), g = to_signed(UInt<F>((rgba >> 8) & 255u));
    const Int<F> b = to_signed(UInt<F>((rgba >> 16) & 255u)), a = to_signed(UInt<F>(rgba >> 24));
    constexpr float unit = 1.f / 255.f; // 255 * unit is 1
    const Vec4T<F> linear{to_float(r) * unit, to_float(g) * unit, to_float(b) * unit, to_float(a) * unit};
    if (!any(is_srgb)) return linear;
    const float* table = tables.srgb_to_linear;
    return select(is_srgb, Vec4T<F>{gather(table, r), gather(table, g), gather(table, b), linear.w}, linear);
}

// Texels of one mip level per lane.
template <class F> struct Texels {
    Pointers<F> first;
    Int<F> channels;
    Mask<F> opaque; // three channels
};

// Texel `place` of bytes in the active lanes. Three are read together with the byte before them, so that nothing beyond the image is read.
template <class F> Vec4T<F> byte_texel(const TextureTables& tables, const Texels<F>& texels, const Int<F>& place, const Mask<F>& is_srgb,
                                       const Mask<F>& active) {
    const Mask<F> with_byte_before = texels.opaque && as_mask(place > 0);
    const Int<F> offset = place * texels.channels - select(with_byte_before, Int<F>(1), Int<F>(0));
    const UInt<F> word = gather_words(texels.first, to_unsigned(offset), active);
    const UInt<F> rgba = select(with_byte_before, UInt<F>(word >> 8), word);
    return decode_texel<F>(tables, select(texels.opaque, UInt<F>(rgba | 0xff000000u), rgba), is_srgb);
}

template <class F> Vec4T<F> half_texel(const Texels<F>& texels, const Int<F>& place, const Mask<F>& active) {
    const Int<F> offset = place * texels.channels * 2;
    const Int<F> next = offset + select(texels.opaque, Int<F>(2), Int<F>(4)); // green and blue, or blue and alpha
    const Int<F> rg = to_signed(gather_words(texels.first, to_unsigned(offset), active));
    const Int<F> last = to_signed(gather_words(texels.first, to_unsigned(next), active));
    const F first = half_value<F>(Int<F>(last & 0x7fff)), second = half_value<F>(Int<F>((last >> 16) & 0x7fff));
    return {half_value<F>(Int<F>(rg & 0x7fff)), half_value<F>(Int<F>((rg >> 16) & 0x7fff)), select(texels.opaque, second, first),
            select(texels.opaque, F(1.f), second)};
}

template <class F> Vec4T<F> float_texel(const Texels<F>& texels, const Int<F>& place, const Mask<F>& active) {
    const UInt<F> offset = to_unsigned(place) * to_unsigned(texels.channels) * 4u;
    const auto channel = [&](const UInt<F>& from) {
        return float_from_bits(to_signed(gather_words(texels.first, UInt<F>(offset + from), active)));
    };
    const F alpha = channel(select(texels.opaque, UInt<F>(0u), UInt<F>(12u)));
    return {channel(UInt<F>(0u)), channel(UInt<F>(4u)), channel(UInt<F>(8u)), select(texels.opaque, F(1.f), alpha)};
}

// The mip levels for a footprint of so many texels: `finer` and, with this weight, the next coarser one. The weight grows from
// one power of two to the next. Up to one texel wide only the image itself is used.
template <class F> struct TextureBlend {
    Int<F> finer;
    F coarser_weight;
};
template <class F> TextureBlend<F> texture_blend(const F& texels, const Int<F>& levels) {
    const F coarsest = float_from_bits(Int<F>((levels + 126) << 23)); // 2^(levels - 1)
    const Int<F> bits = float_bits(F(min(max(texels, F(1.f)), coarsest)));
    return {(bits >> 23) - 127, float_from_bits(Int<F>((bits & 0x7fffff) | 0x3f800000)) - 1.f};
}

// Bilinear or nearest lookup in one mip level in the lanes of `reads`. Not inlined, although kernels are flattened.
template <class F> [[gnu::noinline]] Vec4T<F> texture_level(const TextureTables& tables, const Int<F>& level, const F& s, const F& t,
                                                            const Int<F>& wrap_u, const Int<F>& wrap_v, const Mask<F>& nearest,
                                                            const Mask<F>& reads) {
    const TextureLevel* levels = tables.levels;
    const Int<F> width = gather_field(levels, &TextureLevel::width, level), height = gather_field(levels, &TextureLevel::height, level);
    const TexturePair<F> x = texture_pair<F>(s, width, wrap_u, nearest);
    const TexturePair<F> y = texture_pair<F>(t, height, wrap_v, nearest);
    const Int<F> channels = gather_field(levels, &TextureLevel::channels, level);
    const Texels<F> texels{gather_pointers<F>(levels, &TextureLevel::texels, level), channels, as_mask(channels == 3)};
    const Int<F> encoding = gather_field(levels, &TextureLevel::encoding, level);
    const Mask<F> is_float = reads && as_mask(encoding == encoding_float32), is_half = reads && as_mask(encoding == encoding_half);
    const Mask<F> is_bytes = reads && !is_float && !is_half, is_srgb = as_mask(encoding == encoding_srgb8);
    const auto texel = [&](const Int<F>& column, const Int<F>& row) {
        const Int<F> place = row * width + column;
        Vec4T<F> c{F(1.f), F(1.f), F(1.f), F(1.f)};
        if (any(is_bytes)) c = select(is_bytes, byte_texel<F>(tables, texels, place, is_srgb, is_bytes), c);
        if (any(is_half)) c = select(is_half, half_texel<F>(texels, place, is_half), c);
        if (any(is_float)) c = select(is_float, float_texel<F>(texels, place, is_float), c);
        return c;
    };
    const Vec4T<F> top = lerp(texel(x.first, y.first), texel(x.second, y.first), x.weight);
    const Vec4T<F> bottom = lerp(texel(x.first, y.second), texel(x.second, y.second), x.weight);
    return lerp(top, bottom, y.weight);
}

// Linear RGBA of a texture use: filtered over the footprint or, if not `filtered`, at the point. `use` -1 and inactive lanes
// return white, the neutral element of glTF's "factor times texture". Coordinates and widths may be anything: non-finite ones
// count as 0. Not inlined: a material reads many textures.
template <class F> [[gnu::noinline]] Vec4T<F> lookup(const TextureTables& tables, const Int<F>& use, const TexturePoint<F>& at,
                                                     const Mask<F>& active, bool filtered = true) {
    const Vec4T<F> white{F(1.f), F(1.f), F(1.f), F(1.f)};
    const Mask<F> reads = active && as_mask(use >= 0);
    if (!any(reads)) return white;

    const Int<F> slot = select(reads, use, Int<F>(0));
    const TextureUse* uses = tables.uses;
    const Int<F> uv_set = gather_field(uses, &TextureUse::uv_set, slot);
    F u = at.uv[0].x, v = at.uv[0].y, looked_at = at.width[0];
    for (int set = 1; set < tables.uv_sets; ++set) {
        const Mask<F> on_set = as_mask(uv_set == set);
        u = select(on_set, at.uv[size_t(set)].x, u);
        v = select(on_set, at.uv[size_t(set)].y, v);
        looked_at = select(on_set, at.width[size_t(set)], looked_at);
    }
    F s = gather_field(uses, &TextureUse::u_from_u, slot) * u + gather_field(uses, &TextureUse::u_from_v, slot) * v +
          gather_field(uses, &TextureUse::u_offset, slot);
    F t = gather_field(uses, &TextureUse::v_from_u, slot) * u + gather_field(uses, &TextureUse::v_from_v, slot) * v +
          gather_field(uses, &TextureUse::v_offset, slot);
    s = select(reads && is_finite(s), s, F(0.f));
    t = select(reads && is_finite(t), t, F(0.f));

    const Int<F> texture = gather_field(uses, &TextureUse::texture, slot);
    const TextureRecord* records = tables.textures;
    const Int<F> wrap_u = gather_field(records, &TextureRecord::wrap_u, texture),
                 wrap_v = gather_field(records, &TextureRecord::wrap_v, texture);
    const Mask<F> nearest = as_mask(gather_field(records, &TextureRecord::filter, texture) == filter_nearest);
    const Int<F> first = gather_field(records, &TextureRecord::first_level, texture);
    const F texels = looked_at * gather_field(uses, &TextureUse::texels_per_uv, slot);
    TextureBlend<F> blend{Int<F>(0), F(0.f)};
    if (filtered && any(reads && texels > F(1.f))) blend = texture_blend<F>(texels, gather_field(records, &TextureRecord::levels, texture));
    const Int<F> finer = first + blend.finer;
    const Vec4T<F> fine = texture_level<F>(tables, finer, s, t, wrap_u, wrap_v, nearest && as_mask(blend.finer == 0), reads);
    const Mask<F> mixes = reads && blend.coarser_weight > F(0.f);
    if (!any(mixes)) return select(reads, fine, white);
    const Int<F> coarser = finer + select(mixes, Int<F>(1), Int<F>(0));
    const Vec4T<F> coarse = texture_level<F>(tables, coarser, s, t, wrap_u, wrap_v, Mask<F>(false), mixes);
    return select(reads, select(mixes, lerp(fine, coarse, blend.coarser_weight), fine), white);
}

} // namespace blush::inline BLUSH_ISA
