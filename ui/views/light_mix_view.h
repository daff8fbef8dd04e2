// UI state of the light mix panel; the mix itself is in the document.
#pragma once

#include <string>

namespace blush {

struct LightMixView {
    bool open = false;
    bool disabled_by_user = false; // the user has switched grouping off for this scene
    std::string unfolded;          // the group whose colour settings are shown
};

} // namespace blush
