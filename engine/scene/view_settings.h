// How the finished image is looked at. The render session never receives these: changing them restarts nothing.
#pragma once

#include <string>

namespace blush {

struct ViewSettings {
    float exposure_ev = 0;
    float gamma = 1;
    std::string display = {}; // empty: the config's default
    std::string view = {};    // empty: the display's default
    bool operator==(const ViewSettings&) const = default;
};

} // namespace blush
