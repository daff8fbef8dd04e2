#include "scene/lights/sky_model.h"

#include "core/math.h"
#include "scene/affine.h"
#include "scene/lights/cie_observer.h"
#include "scene/lights/sun_position.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace blush {
namespace {

constexpr double solar_illuminance = 133'300; // lux, outside the atmosphere
constexpr double end_of_twilight = -6;        // degrees

// Relative solar spectrum of Preetham's table 2, 380 to 750 nm in steps of 10.
constexpr double solar_spectrum[] = {165.5, 162.3, 211.2, 258.8, 258.2, 242.3, 267.6, 296.6, 305.4, 300.6, 306.6, 288.3, 287.1,
                                     278.2, 271.0, 272.3, 263.6, 255.0, 250.6, 253.1, 253.5, 251.3, 246.3, 241.7, 236.8, 232.1,
                                     228.2, 223.4, 219.7, 215.3, 211.0, 207.3, 202.4, 198.7, 194.3, 190.7, 186.3, 182.6};
// Absorption of ozone (1/cm) and of water vapour, at their wavelengths; none elsewhere.
struct Absorption {
    double nm, k;
};
constexpr Absorption ozone[] = {
    {355, 0},    {445, .003}, {450, .003}, {455, .004}, {460, .006}, {465, .008}, {470, .009}, {475, .012}, {480, .014}, {485, .017},
    {490, .021}, {495, .025}, {500, .03},  {505, .035}, {510, .04},  {515, .045}, {520, .048}, {525, .057}, {530, .063}, {535, .07},
    {540, .075}, {545, .08},  {550, .085}, {555, .095}, {560, .103}, {565, .110}, {570, .12},  {575, .122}, {580, .12},  {585, .118},
    {590, .115}, {595, .12},  {600, .125}, {605, .130}, {610, .12},  {620, .105}, {630, .09},  {640, .079}, {650, .067}, {660, .057},
    {670, .048}, {680, .036}, {690, .028}, {700, .023}, {710, .018}, {720, .014}, {730, .011}, {740, .010}, {750, .009}};
constexpr Absorption water[] = {{689, 0}, {690, .016}, {700, .024}, {710, .0125}, {720, 1}, {730, .87}, {740, .061}, {750, .001}};

double at(std::span<const Absorption> table, double nm) {
    for (size_t i = 1; i < table.size(); ++i)
        if (nm >= table[i - 1].nm && nm <= table[i].nm)
            return table[i - 1].k + (table[i].k - table[i - 1].k) * (nm - table[i - 1].nm) / (table[i].nm - table[i - 1].nm);
    return 0;
}

} // namespace

double SkyModel::Perez::operator()(double cos_theta, double gamma) const {
    const double cosine = std::cos(gamma);
    return zenith * (1 + a * std::exp(b / std::max(cos_theta, 1e-4))) * (1 + c * std::exp(d * gamma) + e * cosine * cosine);
}

SkyModel::Perez SkyModel::fitted(double a, double b, double c, double d, double e, double zenith) const {
    Perez p{a, b, c, d, e, 1};
    p.zenith = zenith / p(1, sun_theta_);
    return p;
}

void SkyModel::fit_sky(double t) {
    const double s = sun_theta_, s2 = s * s, s3 = s2 * s;
    const double chi = (4.0 / 9 - t / 120) * (std::numbers::pi - 2 * s);
    const double luminance = 1000 * ((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192);
    const double x = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) + t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
                     (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886);
    const double y = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) + t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
                     (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688);
    luminance_ = fitted(0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771, -0.0670 * t + 0.3703,
                        luminance * twilight_);
    x_ = fitted(-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989, -0.0033 * t + 0.0452, x);
    y_ = fitted(-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537, -0.0109 * t + 0.0529, y);
}

Vec3d SkyModel::attenuated_sunlight(double t) const {
    const double mass = 1 / (std::cos(sun_theta_) + 0.15 * std::pow(93.885 - sun_theta_ * 180 / std::numbers::pi, -1.253));
    const double beta = 0.04608 * t - 0.04586; // of aerosols
    Vec3d seen{0, 0, 0};
    double unattenuated = 0;
    for (size_t i = 0; i < std::size(solar_spectrum); ++i) {
        const double nm = 380 + 10 * double(i), um = nm * 1e-3;
        const double vapour = 2 * at(water, nm) * mass; // 2 cm of water
        const double depth = mass * (0.008735 * std::pow(um, -4.08) + beta * std::pow(um, -1.3) + 0.35 * at(ozone, nm)) +
                             0.2385 * vapour / std::pow(1 + 20.07 * vapour, 0.45);
        const Vec3d matching = color_matching(nm);
        unattenuated += solar_spectrum[i] * matching.y;
        seen = seen + matching * (solar_spectrum[i] * std::exp(-depth));
    }
    return rec709_from_xyz(seen * (solar_illuminance / unattenuated));
}

// Cosine-weighted over the upper hemisphere, by the midpoint rule in cos^2 and azimuth; the azimuths are symmetric about the sun's.
Vec3d SkyModel::integrate_sky() const {
    constexpr int rings = 64, sectors = 32;
    const double azimuth = std::atan2(sun_.x, -sun_.z);
    Vec3d sum{0, 0, 0};
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            const double sin2 = (i + 0.5) / rings, sine = std::sqrt(sin2), turn = azimuth + std::numbers::pi * (j + 0.5) / sectors;
            sum = sum + radiance({sine * std::sin(turn), std::sqrt(1 - sin2), -sine * std::cos(turn)});
        }
    return sum * (std::numbers::pi / (rings * sectors));
}

SkyModel::SkyModel(const Sky& sky) {
    const SunPosition position = sun_position(sky);
    sun_ = direction_of({std::max(position.elevation, 0.0), position.azimuth});
    sun_theta_ = std::min(std::numbers::pi / 2, std::acos(std::clamp(sun_.y, -1.0, 1.0)));
    twilight_ = std::clamp(1 - position.elevation / end_of_twilight, 0.0, 1.0);
    const double turbidity = double(sky.turbidity);
    fit_sky(turbidity);
    sky_lux_ = integrate_sky();
    if (position.elevation > 0 && sky.sun_disk) sun_lux_ = attenuated_sunlight(turbidity);
    ground_ = (sky_lux_ + sun_lux_ * std::max(0.0, sun_.y)) * (double(sky.ground_albedo) / std::numbers::pi);
}

SkyModel::Yxy SkyModel::sky(const Vec3d& d) const {
    const double gamma = std::acos(std::clamp(dot(d, sun_), -1.0, 1.0));
    return {std::max(0.0, luminance_(d.y, gamma)), x_(d.y, gamma), y_(d.y, gamma)};
}

Vec3d SkyModel::radiance(const Vec3d& d) const {
    if (d.y < 0) return ground_;
    const Yxy c = sky(d);
    if (!(c.y > 0)) return {0, 0, 0};
    return rec709_from_xyz(Vec3d{c.x / c.y, 1, (1 - c.x - c.y) / c.y} * c.luminance);
}

SkySun sun_of(const Environment& e) {
    if (e.kind != Environment::Kind::sky || !e.sky.sun_disk || !e.lights_scene) return {{0, 1, 0}, {0, 0, 0}};
    const SkyModel model(e.sky);
    const double turn = double(e.rotation_degrees) * std::numbers::pi / 180;
    const Vec3d d = model.sun_direction();
    const Vec3d turned{d.x * std::cos(turn) + d.z * std::sin(turn), d.y, d.z * std::cos(turn) - d.x * std::sin(turn)};
    return {to_float(turned), to_float(model.sun_illuminance()) * e.color * e.intensity};
}

ImagePtr sky_image(const Sky& sky, int width, int height) {
    const SkyModel model(sky);
    auto image = std::make_shared<Image>();
    image->width = width;
    image->height = height;
    image->channels = 3;
    image->floats.reserve(size_t(3 * width * height));
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const double theta = std::numbers::pi * (row + 0.5) / height, turn = 2 * std::numbers::pi * ((column + 0.5) / width - 0.5);
            const Vec3d c = model.radiance({std::sin(theta) * std::sin(turn), std::cos(theta), -std::sin(theta) * std::cos(turn)});
            image->floats.insert(image->floats.end(), {float(c.x), float(c.y), float(c.z)});
        }
    return image;
}

} // namespace blush
