#include "color/color_difference.h"

#include "core/math.h"
#include "core/rec709.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

Vec3d xyz_of(const Vec3d& rgb) { return transform_vector(xyz_from_rec709, rgb); }

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// In degrees, 0 .. 360; 0 for grey.
double hue_of(double a, double b) {
    if (a == 0 && b == 0) return 0;
    const double degrees = std::atan2(b, a) * 180 / std::numbers::pi;
    return degrees < 0 ? degrees + 360 : degrees;
}

struct Hue {
    std::string_view name;
    Vec3d rgb; // linear
};
constexpr std::array<Hue, 8> hues{{{"red", {1, 0, 0}},
                                   {"orange", {1, 0.35, 0}},
                                   {"yellow", {1, 0.9, 0}},
                                   {"green", {0, 1, 0}},
                                   {"cyan", {0, 1, 1}},
                                   {"blue", {0, 0, 1}},
                                   {"violet", {0.35, 0, 1}},
                                   {"magenta", {1, 0, 0.8}}}};

} // namespace

UcsPoint ucs_of(const Vec3d& rgb) {
    const Vec3d c = xyz_of(rgb);
    const double d = c.x + 15 * c.y + 3 * c.z;
    if (!(d > 0)) return ucs_of({1, 1, 1});
    return {4 * c.x / d, 9 * c.y / d};
}

Lab lab_of(const Vec3d& rgb, double white) {
    const auto f = [](double t) {
        constexpr double delta = 6.0 / 29;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
    };
    const Vec3d c = xyz_of(rgb);
    const Vec3d d65 = xyz_of({1, 1, 1});
    const double x = f(c.x / (white * d65.x)), y = f(c.y / white), z = f(c.z / (white * d65.z));
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double delta_e_2000(const Lab& x, const Lab& y) {
    const auto pow7 = [](double v) { return std::pow(v, 7); };
    constexpr double pow7_of_25 = 6103515625;
    // Equations 2 to 7.
    const double mean_c = (std::hypot(x.a, x.b) + std::hypot(y.a, y.b)) / 2;
    const double g = 0.5 * (1 - std::sqrt(pow7(mean_c) / (pow7(mean_c) + pow7_of_25)));
    const double a1 = (1 + g) * x.a, a2 = (1 + g) * y.a;
    const double c1 = std::hypot(a1, x.b), c2 = std::hypot(a2, y.b);
    const double h1 = hue_of(a1, x.b), h2 = hue_of(a2, y.b);
    // 8 to 11.
    const double dl = y.l - x.l, dc = c2 - c1;
    const bool grey = c1 * c2 == 0;
    double dh = grey ? 0 : h2 - h1;
    if (dh > 180) dh -= 360;
    if (dh < -180) dh += 360;
    const double dh_metric = 2 * std::sqrt(c1 * c2) * std::sin(radians(dh / 2));
    // 12 to 14.
    const double l = (x.l + y.l) / 2, c = (c1 + c2) / 2;
    double h = h1 + h2;
    if (!grey) h = std::abs(h1 - h2) <= 180 ? h / 2 : h < 360 ? (h + 360) / 2 : (h - 360) / 2;
    // 15 to 22.
    const double t = 1 - 0.17 * std::cos(radians(h - 30)) + 0.24 * std::cos(radians(2 * h)) + 0.32 * std::cos(radians(3 * h + 6)) -
                     0.20 * std::cos(radians(4 * h - 63));
    const double rotation = 30 * std::exp(-std::pow((h - 275) / 25, 2));
    const double rc = 2 * std::sqrt(pow7(c) / (pow7(c) + pow7_of_25));
    const double from_50 = (l - 50) * (l - 50);
    const double sl = 1 + 0.015 * from_50 / std::sqrt(20 + from_50), sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t;
    const double rt = -std::sin(radians(2 * rotation)) * rc;
    const double tl = dl / sl, tc = dc / sc, th = dh_metric / sh;
    return std::sqrt(std::max(0.0, tl * tl + tc * tc + th * th + rt * tc * th));
}

double white_for_grey(double luminance) { return luminance / std::pow((50 + 16) / 116.0, 3); }

double hue_difference(const Vec3d& x, const Vec3d& y) {
    const double at_x = luminance(x), at_y = luminance(y);
    if (!(at_x > 0 && at_y > 0)) return 0;
    return delta_e_2000(lab_of(x, white_for_grey(at_x)), lab_of(y, white_for_grey(at_y)));
}

std::string_view hue_towards(double du, double dv) {
    const UcsPoint white = ucs_of({1, 1, 1});
    const auto cosine = [&](const Hue& hue) {
        const UcsPoint p = ucs_of(hue.rgb);
        return ((p.u - white.u) * du + (p.v - white.v) * dv) / std::hypot(p.u - white.u, p.v - white.v);
    };
    return std::ranges::max_element(hues, {}, cosine)->name;
}

} // namespace blush
