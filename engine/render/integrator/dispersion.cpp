#include "render/integrator/dispersion.h"

#include "scene/lights/cie_observer.h"

#include <vector>

namespace blush {
namespace {

constexpr double min_wavelength = 380, max_wavelength = 730, grid = 0.25; // nanometres

Spectrum make_spectrum() {
    std::vector<Vec3d> colors;
    Vec3d total{0, 0, 0};
    for (double nm = min_wavelength + grid / 2; nm < max_wavelength; nm += grid)
        total = total + colors.emplace_back(rec709_from_xyz(color_matching(nm)));
    // Each channel is normalised to 1, and a wavelength's probability is the mean of its channels.
    for (Vec3d& c : colors) c = {c.x / total.x, c.y / total.y, c.z / total.z};

    Spectrum spectrum;
    Vec3d sum{0, 0, 0};
    std::vector<Vec3d> rgb;
    size_t at = 0;
    double below = 0; // cumulative probability of all wavelengths before `at`
    for (int step = 0; step < Spectrum::steps; ++step) {
        const double wanted = (step + 0.5) / Spectrum::steps;
        const auto probability = [&] { return (colors[at].x + colors[at].y + colors[at].z) / 3; };
        while (at + 1 < colors.size() && below + probability() < wanted) below += probability(), ++at;
        spectrum.nanometres[step] = float(min_wavelength + grid * (double(at) + (wanted - below) / probability()));
        rgb.push_back(colors[at] / probability());
        sum = sum + rgb.back() / double(Spectrum::steps);
    }
    for (int step = 0; step < Spectrum::steps; ++step) {
        const Vec3d& c = rgb[size_t(step)];
        spectrum.rgb[3 * step] = float(c.x / sum.x);
        spectrum.rgb[3 * step + 1] = float(c.y / sum.y);
        spectrum.rgb[3 * step + 2] = float(c.z / sum.z);
    }
    return spectrum;
}

} // namespace

const Spectrum& visible_spectrum() {
    static const Spectrum spectrum = make_spectrum();
    return spectrum;
}

} // namespace blush
