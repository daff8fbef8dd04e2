// Vectors, frames and elementary functions over a lane type. The approximations are bit-identical for every lane type and
// instruction set: they use only +, -, *, / and sqrt, without FMA contraction.
#pragma once

#include "core/lanes.h"
#include "core/vec.h"

#include <numbers>

namespace blush::inline BLUSH_ISA {

constexpr float pi = std::numbers::pi_v<float>;
constexpr double degrees_per_radian = 180 / std::numbers::pi;
constexpr float inv_pi = std::numbers::inv_pi_v<float>;
constexpr float infinity = __builtin_inff();
constexpr float one_minus_epsilon = 0x1.fffffep-1f;

// ---- vectors
template <class F> Vec<F> operator+(const Vec<F>& a, const Vec<F>& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <class F> Vec<F> operator-(const Vec<F>& a, const Vec<F>& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class F> Vec<F> operator*(const Vec<F>& a, const Vec<F>& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
template <class F> Vec<F> operator*(const Vec<F>& a, const std::type_identity_t<F>& s) { return {a.x * s, a.y * s, a.z * s}; }
template <class F> Vec<F> operator*(const std::type_identity_t<F>& s, const Vec<F>& a) { return a * s; }
template <class F> Vec<F> operator/(const Vec<F>& a, const std::type_identity_t<F>& s) { return {a.x / s, a.y / s, a.z / s}; }
template <class F> Vec<F> operator-(const Vec<F>& a) { return {-a.x, -a.y, -a.z}; }
template <class F> F dot(const Vec<F>& a, const Vec<F>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class F> Vec<F> cross(const Vec<F>& a, const Vec<F>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class F> F length_squared(const Vec<F>& a) { return dot(a, a); }
template <class F> F length(const Vec<F>& a) {
    using std::sqrt;
    return sqrt(dot(a, a));
}
template <class F> Vec<F> normalize(const Vec<F>& a) { return a / length(a); }
template <class F> F max_component(const Vec<F>& a) { return max(a.x, max(a.y, a.z)); }
template <class F> Vec<F> abs(const Vec<F>& a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
template <class F> Vec<F> select(const Mask<F>& m, const Vec<F>& a, const Vec<F>& b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
template <class F> Vec<F> splat(const Vec3& v) { return {F(v.x), F(v.y), F(v.z)}; }
template <class F> Vec<F> splat(float s) { return {F(s), F(s), F(s)}; }
template <class F> Vec<F> lerp(const Vec<F>& a, const Vec<F>& b, const std::type_identity_t<F>& t) { return a + (b - a) * t; }
template <class F> F lerp(F a, F b, F t) { return a + (b - a) * t; }
template <class F> F clamp01(const F& x) { return min(max(x, F(0.f)), F(1.f)); }
template <class F> Vec<F> clamp01(const Vec<F>& v) { return {clamp01(v.x), clamp01(v.y), clamp01(v.z)}; }
// Luminance: Y of linear Rec.709 (D65), the row of xyz_from_rec709 (rec709.h) as pbrt rounds it.
constexpr Vec3d luminance_weights{0.212671, 0.715160, 0.072169};
template <class F> F luminance(const Vec<F>& c) {
    return float(luminance_weights.x) * c.x + float(luminance_weights.y) * c.y + float(luminance_weights.z) * c.z;
}
template <class F> Mask<F> is_finite(const Vec<F>& a) { return is_finite(a.x) && is_finite(a.y) && is_finite(a.z); }
// Three consecutive floats at p[3 * i].
template <class F> Vec<F> gather3(const float* p, const Int<F>& i) {
    const Int<F> at = i * 3;
    return {gather(p, at), gather(p + 1, at), gather(p + 2, at)};
}
template <class F, class Record> Vec<F> gather_field3(const Record* records, Vec3 Record::*field, const Int<F>& i) {
    static_assert(sizeof(Record) % 4 == 0);
    const float* p = &(records->*field).x;
    const Int<F> at = i * int32_t(sizeof(Record) / 4);
    return {gather(p, at), gather(p + 1, at), gather(p + 2, at)};
}
template <class F> Vec2T<F> operator+(const Vec2T<F>& a, const Vec2T<F>& b) { return {a.x + b.x, a.y + b.y}; }
template <class F> Vec2T<F> operator*(const Vec2T<F>& a, const std::type_identity_t<F>& s) { return {a.x * s, a.y * s}; }

// ---- affine maps
template <class T> Vec<T> transform_vector(const AffineT<T>& m, const Vec<T>& v) { return m.x * v.x + m.y * v.y + m.z * v.z; }
template <class T> Vec<T> transform_point(const AffineT<T>& m, const Vec<T>& p) { return transform_vector(m, p) + m.t; }
template <class T> AffineT<T> operator*(const AffineT<T>& a, const AffineT<T>& b) {
    return {transform_vector(a, b.x), transform_vector(a, b.y), transform_vector(a, b.z), transform_point(a, b.t)};
}
template <class T> T determinant(const AffineT<T>& m) { return dot(m.x, cross(m.y, m.z)); }
// Cofactor matrix: inverse transpose of the linear part times the determinant. Transforms normals, up to length.
template <class T> AffineT<T> cofactor(const AffineT<T>& m) { return {cross(m.y, m.z), cross(m.z, m.x), cross(m.x, m.y), {0, 0, 0}}; }
// Undefined for a singular map.
template <class T> AffineT<T> inverse(const AffineT<T>& m) {
    const AffineT<T> c = cofactor(m);
    const T s = T(1) / determinant(m);
    AffineT<T> r;
    r.x = Vec<T>{c.x.x, c.y.x, c.z.x} * s;
    r.y = Vec<T>{c.x.y, c.y.y, c.z.y} * s;
    r.z = Vec<T>{c.x.z, c.y.z, c.z.z} * s;
    r.t = -transform_vector(r, m.t);
    return r;
}

// ---- orthonormal frame around a unit normal: Duff et al. 2017, "Building an Orthonormal Basis, Revisited"
template <class F> struct Basis {
    Vec<F> s, t, n;
    Vec<F> to_local(const Vec<F>& v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
    Vec<F> to_world(const Vec<F>& v) const { return s * v.x + t * v.y + n * v.z; }
};
template <class F> Basis<F> basis_around(const Vec<F>& n) {
    const F sign = select(n.z < F(0.f), F(-1.f), F(1.f));
    const F a = F(-1.f) / (sign + n.z);
    const F b = n.x * n.y * a;
    return {{1.f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

// ---- elementary functions
template <class F> struct SinCos { F sin, cos; };
// sin and cos of 2 pi u for u in [-4, 4]; minimax polynomials, error below 1e-7.
template <class F> SinCos<F> sincos_turns(const F& u) {
    const F x = u * 4.f;
    const F q = floor(x + 0.5f);
    const F r = (x - q) * (pi / 2);
    const F r2 = r * r;
    const F s = r * (1.f + r2 * (-1.6666654611e-1f + r2 * (8.3321608736e-3f + r2 * -1.9515295891e-4f)));
    const F c = 1.f + r2 * (-0.5f + r2 * (4.166664568e-2f + r2 * (-1.388731625e-3f + r2 * 2.443315712e-5f)));
    const Int<F> k = to_int(q);
    const Mask<F> swap = as_mask((k & 1) != 0), negate_sin = as_mask((k & 2) != 0), negate_cos = as_mask(((k + 1) & 2) != 0);
    const F a = select(swap, c, s), b = select(swap, s, c);
    return {select(negate_sin, -a, a), select(negate_cos, -b, b)};
}

// e^x: 2^k e^r with |r| <= ln2 / 2, Taylor to r^7; relative error below 2e-7. 0 below -87, e^88 above 88.
// Call it as blush::exp: an unqualified call with a register finds that of std::experimental::simd, which gives other bits.
template <class F> F exp(const F& x) {
    const F c = min(max(x, F(-88.f)), F(88.f));
    const F k = floor(c * 1.44269504f + 0.5f);
    const F r = (c - k * 0.693359375f) - k * -2.12194440e-4f;
    const F p = 1.f + r * (1.f + r * (0.5f + r * (0.166666667f +
                                                  r * (0.0416666667f + r * (8.33333333e-3f + r * (1.38888889e-3f + r * 1.98412698e-4f))))));
    const F scale = float_from_bits((to_int(k) + 127) << 23);
    return select(x < F(-87.f), F(0.f), p * scale);
}

// Natural logarithm of x > 0: exponent and series of atanh around 1; relative error below 2e-7, absolute near x = 1. Call it as
// blush::log, like exp.
template <class F> F log(const F& x) {
    const Int<F> bits = float_bits(x);
    const Int<F> k = (bits - 0x3f3504f3) >> 23; // so that the mantissa is in [sqrt(1/2), sqrt(2))
    const F m = float_from_bits(Int<F>(bits - (k << 23)));
    const F s = (m - 1.f) / (m + 1.f), s2 = s * s;
    const F series = 2.f * s * (1.f + s2 * (0.333333333f + s2 * (0.2f + s2 * (0.142857143f + s2 * 0.111111111f))));
    const F e = to_float(k);
    return e * 0.693359375f + (e * -2.12194440e-4f + series);
}

// Four-quadrant arc tangent of y / x in turns, [-0.5, 0.5]; atan2(0, 0) = 0. Minimax odd polynomial on [0, 1], error below 1.4e-7
// turns.
template <class F> F atan2_turns(const F& y, const F& x) {
    const F ax = abs(x), ay = abs(y);
    const F high = max(ax, ay), low = min(ax, ay);
    const F r = select(high > F(0.f), low / select(high > F(0.f), high, F(1.f)), F(0.f));
    // Halve the range: atan(r) = pi/8 + atan((r - tan(pi/8)) / (1 + r tan(pi/8))) above tan(pi/16).
    const F t = 0.41421356f;
    const Mask<F> big = r > F(0.19891237f);
    const F q = select(big, (r - t) / (1.f + r * t), r);
    const F q2 = q * q;
    const F p = q * (1.f + q2 * (-0.333333333f + q2 * (0.2f + q2 * (-0.142857143f + q2 * (0.111111111f + q2 * -0.0909090909f)))));
    F a = (select(big, F(pi / 8), F(0.f)) + p) * (inv_pi / 2);
    a = select(ay > ax, 0.25f - a, a);
    a = select(x < F(0.f), 0.5f - a, a);
    return select(y < F(0.f), -a, a);
}

template <class F> F pow5(const F& x) {
    const F x2 = x * x;
    return x2 * x2 * x;
}

} // namespace blush::inline BLUSH_ISA
