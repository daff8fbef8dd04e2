// The OCIO configuration shipped with Blush, for tests.
#pragma once

#include "color/color_management.h"

#include <stdexcept>

namespace blush::test {

// Throws if it cannot be loaded, which fails the test.
inline ColorManagement our_colors() {
    auto loaded = ColorManagement::load(BLUSH_ASSETS);
    if (!loaded) throw std::runtime_error(loaded.error().text());
    return *std::move(loaded);
}

} // namespace blush::test
