// Image textures: glTF's wrap modes and filters over tables that hold the texels of all images of a scene.
// Texels are made linear first and filtered then, as sRGB samplers of graphics hardware do; filtering encoded values would
// darken every edge.
#pragma once

#include "core/math.h"

#include <array>

namespace blush {

enum TextureWrap : int32_t { wrap_repeat, wrap_clamp, wrap_mirror };
enum TextureFilter : int32_t { filter_linear, filter_nearest };
// Where the texels of a texture are and what they mean. Alpha is always linear.
enum TextureEncoding : int32_t {
    encoding_srgb8,   // rgba8, colour sRGB-encoded
    encoding_linear8, // rgba8
    encoding_float32, // rgba32f
};

struct TextureRecord {
    int32_t offset; // of the first texel, in texels, within its pool
    int32_t width, height;
    int32_t wrap_u, wrap_v; // TextureWrap
    int32_t filter;         // TextureFilter
    int32_t encoding;       // TextureEncoding
};

// So many different UV sets can the textures of one scene lie on.
constexpr int most_uv_sets = 8;

// A texture as one slot of a material reads it: u' = u_from_u * u + u_from_v * v + u_offset, the same for v'.
struct TextureUse {
    int32_t texture; // index of a TextureRecord
    int32_t uv_set;  // which of TexturePoint::uv
    float u_from_u, u_from_v, u_offset;
    float v_from_u, v_from_v, v_offset;
};

// Pools hold four channels per texel, top row first; every value in them is finite.
struct TextureTables {
    const TextureRecord* textures = nullptr;
    const TextureUse* uses = nullptr;
    const uint32_t* rgba8 = nullptr;       // red in the lowest byte; below 2^31 texels
    const float* rgba32f = nullptr;        // below 2^29 texels
    const float* srgb_to_linear = nullptr; // of the 256 byte values
    int32_t uv_sets = 0;                   // that the uses are laid out by
};

} // namespace blush

namespace blush::inline BLUSH_ISA {

template <class F> Vec4T<F> select(const Mask<F>& m, const Vec4T<F>& a, const Vec4T<F>& b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w)};
}
// Gives a back exactly for t = 0 and wherever a = b.
template <class F> Vec4T<F> lerp(const Vec4T<F>& a, const Vec4T<F>& b, const std::type_identity_t<F>& t) {
    return {lerp(a.x, b.x, t), lerp(a.y, b.y, t), lerp(a.z, b.z, t), lerp(a.w, b.w, t)};
}
template <class F> Vec<F> rgb(const Vec4T<F>& c) { return {c.x, c.y, c.z}; }

// Where a point of a surface lies on its textures.
template <class F> struct TexturePoint {
    std::array<Vec2T<F>, most_uv_sets> uv; // the first TextureTables::uv_sets of them
};

// The two texels of one axis that a coordinate lies between, both in [0, size), and the weight of the second.
template <class F> struct TexturePair {
    Int<F> first, second;
    F weight;
};

// `s` in units of the image, any finite number. Texel i covers [i, i + 1] / size, its centre is where it is seen unmixed.
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
    // Past an edge a repeated image goes on at the other; the neighbour of an edge texel in a mirror is that texel itself.
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

// Linear RGBA of a texture use at a point. `use` -1 and lanes that are not active read white,
// the neutral element of glTF's "factor times texture". Coordinates may be anything: those that are not finite read as 0.
// Out of line: a material reads up to seven textures, and kernels are flattened.
template <class F> [[gnu::noinline]] Vec4T<F> lookup(const TextureTables& tables, const Int<F>& use, const TexturePoint<F>& at,
                                                     const Mask<F>& active) {
    const Vec4T<F> white{F(1.f), F(1.f), F(1.f), F(1.f)};
    const Mask<F> reads = active && as_mask(use >= 0);
    if (!any(reads)) return white;

    const Int<F> slot = select(reads, use, Int<F>(0));
    const TextureUse* uses = tables.uses;
    const Int<F> uv_set = gather_field(uses, &TextureUse::uv_set, slot);
    F u = at.uv[0].x, v = at.uv[0].y;
    for (int set = 1; set < tables.uv_sets; ++set) {
        const Mask<F> on_set = as_mask(uv_set == set);
        u = select(on_set, at.uv[size_t(set)].x, u);
        v = select(on_set, at.uv[size_t(set)].y, v);
    }
    F s = gather_field(uses, &TextureUse::u_from_u, slot) * u + gather_field(uses, &TextureUse::u_from_v, slot) * v +
          gather_field(uses, &TextureUse::u_offset, slot);
    F t = gather_field(uses, &TextureUse::v_from_u, slot) * u + gather_field(uses, &TextureUse::v_from_v, slot) * v +
          gather_field(uses, &TextureUse::v_offset, slot);
    s = select(reads && is_finite(s), s, F(0.f));
    t = select(reads && is_finite(t), t, F(0.f));

    const Int<F> texture = gather_field(uses, &TextureUse::texture, slot);
    const TextureRecord* records = tables.textures;
    const Int<F> width = gather_field(records, &TextureRecord::width, texture);
    const Int<F> height = gather_field(records, &TextureRecord::height, texture);
    const Mask<F> nearest = as_mask(gather_field(records, &TextureRecord::filter, texture) == filter_nearest);
    const TexturePair<F> x = texture_pair<F>(s, width, gather_field(records, &TextureRecord::wrap_u, texture), nearest);
    const TexturePair<F> y = texture_pair<F>(t, height, gather_field(records, &TextureRecord::wrap_v, texture), nearest);

    const Int<F> offset = gather_field(records, &TextureRecord::offset, texture);
    const Int<F> encoding = gather_field(records, &TextureRecord::encoding, texture);
    const Mask<F> is_float = reads && as_mask(encoding == encoding_float32), is_bytes = reads && !is_float;
    const Mask<F> is_srgb = as_mask(encoding == encoding_srgb8);
    const auto texel = [&](const Int<F>& column, const Int<F>& row) {
        const Int<F> place = offset + row * width + column;
        Vec4T<F> c = white;
        if (any(is_bytes)) {
            c = select(is_bytes, decode_texel<F>(tables, gather(tables.rgba8, select(is_bytes, place, Int<F>(0))), is_srgb), c);
        }
        if (any(is_float)) {
            const Int<F> i = select(is_float, place, Int<F>(0)) * 4;
            const float* p = tables.rgba32f;
            c = select(is_float, Vec4T<F>{gather(p, i), gather(p + 1, i), gather(p + 2, i), gather(p + 3, i)}, c);
        }
        return c;
    };
    const Vec4T<F> top = lerp(texel(x.first, y.first), texel(x.second, y.first), x.weight);
    const Vec4T<F> bottom = lerp(texel(x.first, y.second), texel(x.second, y.second), x.weight);
    return lerp(top, bottom, y.weight);
}

} // namespace blush::inline BLUSH_ISA
