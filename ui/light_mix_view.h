// The light mix panel's own state; the mix itself is the document's.
#pragma once

#include <string>

namespace blush {

struct LightMixView {
    bool open = false;
    bool stays_off = false; // the user has turned grouping off in this scene
    std::string unfolded; // the group whose colour is shown
};

} // namespace blush
