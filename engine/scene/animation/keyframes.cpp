#include "scene/animation/keyframes.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

using Interpolation = Keyframes::Interpolation;

size_t floats_per_key(const Keyframes& k) { return k.values.size() / k.times.size(); }

// Two neighbouring keyframes; the same one twice if the time is on or outside them.
struct Moment {
    size_t before = 0, after = 0;
    double fraction = 0; // position between them, 0 .. 1
    double seconds = 0;  // between the two
};

Moment find(const Keyframes& k, float seconds) {
    const auto next = std::upper_bound(k.times.begin(), k.times.end(), seconds);
    if (next == k.times.begin()) return {};
    const auto before = size_t(next - k.times.begin()) - 1;
    if (next == k.times.end() || k.interpolation == Interpolation::step) return {before, before, 0, 0};
    const double begin = k.times[before], length = *next - begin;
    return {before, before + 1, (seconds - begin) / length, length};
}

// Parts of a cubic spline key: 0 in-tangent, 1 value, 2 out-tangent.
const float* part_of(const Keyframes& k, size_t key, size_t part) {
    const float* values = k.values.data() + key * floats_per_key(k);
    return k.interpolation == Interpolation::cubic_spline ? values + part * width_of(k) : values;
}

double spline(const Keyframes& k, const Moment& m, size_t i) {
    const double t = m.fraction, t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * part_of(k, m.before, 1)[i] + m.seconds * (t3 - 2 * t2 + t) * part_of(k, m.before, 2)[i] +
           (3 * t2 - 2 * t3) * part_of(k, m.after, 1)[i] + m.seconds * (t3 - t2) * part_of(k, m.after, 0)[i];
}

// Normalised quaternion; zero and non-finite input gives the identity.
Quat unit(double x, double y, double z, double w) {
    const double size = std::sqrt(x * x + y * y + z * z + w * w);
    if (!(size > 0) || !std::isfinite(size)) return {};
    return {float(x / size), float(y / size), float(z / size), float(w / size)};
}

Quat slerp(const float* a, const float* b, double t) {
    double d = 0, aa = 0, bb = 0;
    for (int i = 0; i < 4; ++i) d += double(a[i]) * b[i], aa += double(a[i]) * a[i], bb += double(b[i]) * b[i];
    const double cosine = std::min(1.0, std::abs(d) / std::sqrt(aa * bb));
    const double angle = std::acos(cosine), sine = std::sin(angle);
    // Nearly equal rotations: slerp is replaced by linear interpolation.
    const bool straight = !(sine > 1e-9);
    const double from = straight ? 1 - t : std::sin((1 - t) * angle) / sine;
    const double to = (straight ? t : std::sin(t * angle) / sine) * (d < 0 ? -1 : 1);
    return unit(from * a[0] + to * b[0], from * a[1] + to * b[1], from * a[2] + to * b[2], from * a[3] + to * b[3]);
}

} // namespace

size_t width_of(const Keyframes& k) { return floats_per_key(k) / (k.interpolation == Interpolation::cubic_spline ? 3 : 1); }

std::vector<float> value_at(const Keyframes& k, float seconds) {
    const Moment m = find(k, seconds);
    std::vector<float> value(width_of(k));
    const float *a = part_of(k, m.before, 1), *b = part_of(k, m.after, 1);
    for (size_t i = 0; i < value.size(); ++i) {
        if (m.before == m.after)
            value[i] = a[i];
        else if (k.interpolation == Interpolation::cubic_spline)
            value[i] = float(spline(k, m, i));
        else
            value[i] = float((1 - m.fraction) * a[i] + m.fraction * b[i]);
    }
    return value;
}

Quat rotation_at(const Keyframes& k, float seconds) {
    const Moment m = find(k, seconds);
    const float* a = part_of(k, m.before, 1);
    if (m.before == m.after) return unit(a[0], a[1], a[2], a[3]);
    if (k.interpolation == Interpolation::cubic_spline) return unit(spline(k, m, 0), spline(k, m, 1), spline(k, m, 2), spline(k, m, 3));
    return slerp(a, part_of(k, m.after, 1), m.fraction);
}

} // namespace blush
