// Sky and sun model: Preetham, Shirley and Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999.
//
// The clear sky's luminance and chromaticity by Perez's formula, with coefficients linear in the turbidity and values at the
// zenith by the sun's height (appendix A.2); sunlight as the solar spectrum attenuated by Rayleigh scattering, aerosols, ozone
// and water vapour (appendix A.1; the absorption of mixed gases begins at 759 nm, outside the visible range). Two things differ
// from the paper: its solar spectrum is scaled to an illuminance of 133.3 klx outside the atmosphere (Darula, Kittler and
// Gueymard 2005, "Reference luminous solar constant"), and as the model covers daytime only, the sky of sunset fades to black
// until the sun is 6 degrees below the horizon. Directions below the horizon see a diffuse ground, lit by sky and sun.
#pragma once

#include "scene/scene.h"

namespace blush {

// Full angle that the sun subtends, radians.
constexpr float sun_angle_radians = 0.0093f;

class SkyModel {
public:
    explicit SkyModel(const Sky& sky);

    // Luminance (nits) and CIE chromaticity x, y in a unit direction above the horizon.
    struct Yxy {
        double luminance, x, y;
    };
    Yxy sky(const Vec3d& direction) const;
    // Radiance of the sky, or of the ground below the horizon: linear Rec.709 nits.
    Vec3d radiance(const Vec3d& direction) const;

    // Unit vector towards the sun, clamped to the horizon; illuminance by its disk on a surface that faces it, linear Rec.709
    // lux, 0 below the horizon.
    const Vec3d& sun_direction() const { return sun_; }
    const Vec3d& sun_illuminance() const { return sun_lux_; }
    // Illuminance of a horizontal surface by the sky without the sun's disk, linear Rec.709 lux.
    const Vec3d& sky_illuminance() const { return sky_lux_; }

private:
    struct Perez {
        double a, b, c, d, e, zenith; // zenith: the value at the zenith divided by F(0, theta_sun)
        double operator()(double cos_theta, double gamma) const;
    };
    Perez fitted(double a, double b, double c, double d, double e, double zenith) const;
    void fit_sky(double turbidity);
    Vec3d attenuated_sunlight(double turbidity) const;
    Vec3d integrate_sky() const;

    Vec3d sun_;
    double sun_theta_ = 0; // angle from the zenith, at most pi / 2
    double twilight_ = 1;
    Perez luminance_{}, x_{}, y_{};
    Vec3d sun_lux_{0, 0, 0}, sky_lux_{0, 0, 0}, ground_{0, 0, 0};
};

// The sun of a sky environment, with the environment's rotation and intensity.
struct SkySun {
    Vec3 direction; // unit, towards it
    Vec3 lux;       // linear Rec.709; black if there is no sun
};
SkySun sun_of(const Environment& environment);

// The sky as a lat-long image of linear Rec.709 nits, without the sun's disk.
ImagePtr sky_image(const Sky& sky, int width, int height);

} // namespace blush
