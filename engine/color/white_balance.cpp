#include "color/white_balance.h"

#include "core/math.h"
#include "core/rec709.h"

#include <cmath>

namespace blush {
namespace {

// Columns. Bradford.
constexpr Affined cones_from_xyz{{0.8951, -0.7502, 0.0389}, {0.2664, 1.7135, -0.0685}, {-0.1614, 0.0367, 1.0296}, {0, 0, 0}};

bool is_color(const Vec3& c) {
    const auto good = [](float x) { return std::isfinite(x) && x >= 0; };
    return good(c.x) && good(c.y) && good(c.z) && c.x + c.y + c.z > 0;
}

} // namespace

Affine white_balance(const Vec3& neutral) {
    if (!is_color(neutral) || (neutral.x == neutral.y && neutral.y == neutral.z)) return {};
    const Affined cones_from_rgb = cones_from_xyz * xyz_from_rec709;
    const Vec3d rgb{neutral.x, neutral.y, neutral.z};
    const double y = transform_vector(xyz_from_rec709, rgb).y;
    const Vec3d from = transform_vector(cones_from_rgb, rgb / y), to = transform_vector(cones_from_rgb, Vec3d{1, 1, 1});
    const Affined gains{{to.x / from.x, 0, 0}, {0, to.y / from.y, 0}, {0, 0, to.z / from.z}, {0, 0, 0}};
    const Affined m = inverse(cones_from_rgb) * gains * cones_from_rgb;
    const auto narrow = [](const Vec3d& v) { return Vec3{float(v.x), float(v.y), float(v.z)}; };
    return {narrow(m.x), narrow(m.y), narrow(m.z), {0, 0, 0}};
}

} // namespace blush
