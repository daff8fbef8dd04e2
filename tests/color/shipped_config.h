// Helpers of the colour tests: the shipped config independent of $OCIO, and one pixel through a view.
#pragma once

#include "color/color_management.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace blush {

using Pixel = std::array<float, 3>;

// Half a step of a 16-bit file: invisible in saved images.
constexpr double invisible = 0.5 / 65535;

inline Pixel grey(float x) { return {x, x, x}; }
inline float luminance(const Pixel& p) { return 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2]; }

inline ColorManagement shipped_config() {
    unsetenv("OCIO");
    auto color = ColorManagement::load(BLUSH_ASSETS);
    if (!color) throw std::runtime_error(color.error().text());
    return std::move(*color);
}

inline Pixel show(const ColorManagement& color, std::string_view display, std::string_view view, Pixel pixel, float exposure_ev = 0,
                  float gamma = 1) {
    const auto done =
        color.apply_display({std::string(display), std::string(view)}, {.exposure_ev = exposure_ev, .gamma = gamma}, pixel.data(), 1);
    EXPECT_TRUE(done) << (done ? "" : done.error().text());
    return pixel;
}

inline double srgb_encoded(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }

} // namespace blush
