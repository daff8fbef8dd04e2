#include "scene/affine.h"

#include <cmath>

namespace blush {

Vec3d any_perpendicular(const Vec3d& a) {
    const Vec3d least = std::abs(a.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    return normalize(cross(a, least));
}

Vec3d to_double(const Vec3& a) { return {a.x, a.y, a.z}; }
Vec3 to_float(const Vec3d& a) { return {float(a.x), float(a.y), float(a.z)}; }
Affined to_double(const Affine& a) { return {to_double(a.x), to_double(a.y), to_double(a.z), to_double(a.t)}; }
Affine to_float(const Affined& a) { return {to_float(a.x), to_float(a.y), to_float(a.z), to_float(a.t)}; }

bool is_finite(const Affined& m) {
    for (const Vec3d& c : {m.x, m.y, m.z, m.t})
        if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z)) return false;
    return true;
}

Affined to_affine(const Quat& rotation) {
    double x = rotation.x, y = rotation.y, z = rotation.z, w = rotation.w;
    const double norm = std::sqrt(x * x + y * y + z * z + w * w);
    if (!(norm > 0)) return {};
    x /= norm, y /= norm, z /= norm, w /= norm;
    return {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
            {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
            {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
            {0, 0, 0}};
}

// Shepperd 1978: start from the largest of the four components, so that no difference of near-equals is divided by.
Quat to_quat(const Affined& m) {
    const double four_xx = 1 + m.x.x - m.y.y - m.z.z, four_yy = 1 - m.x.x + m.y.y - m.z.z;
    const double four_zz = 1 - m.x.x - m.y.y + m.z.z, four_ww = 1 + m.x.x + m.y.y + m.z.z;
    double x, y, z, w;
    if (four_ww >= four_xx && four_ww >= four_yy && four_ww >= four_zz)
        x = m.y.z - m.z.y, y = m.z.x - m.x.z, z = m.x.y - m.y.x, w = four_ww;
    else if (four_xx >= four_yy && four_xx >= four_zz)
        x = four_xx, y = m.x.y + m.y.x, z = m.z.x + m.x.z, w = m.y.z - m.z.y;
    else if (four_yy >= four_zz)
        x = m.x.y + m.y.x, y = four_yy, z = m.y.z + m.z.y, w = m.z.x - m.x.z;
    else
        x = m.z.x + m.x.z, y = m.y.z + m.z.y, z = four_zz, w = m.x.y - m.y.x;
    const double norm = std::sqrt(x * x + y * y + z * z + w * w);
    const double sign = w < 0 ? -1 / norm : 1 / norm;
    return {float(x * sign), float(y * sign), float(z * sign), float(w * sign)};
}

} // namespace blush
