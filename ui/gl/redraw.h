// Says whether a UI frame looks different from the one on the screen. Most of a frame's time is drawing and swapping, which a frame
// without a difference saves: while an image is drawn over several UI frames, after input that changes nothing, or while ImGui
// settles.
#pragma once

#include <cstddef>
#include <vector>

struct ImDrawData;

namespace blush {

// Call after changing the pixels or the filter of a texture: draw data refers to a texture by its name, which stays.
void textures_changed();

class Redraw {
public:
    // True if `data`, or the content of any texture, differs from the last call. `data` is ImGui's draw data after Render().
    bool is_needed(const ImDrawData& data);
    // The next frame is needed: the window system has lost the content of the window.
    void force() { drawn_.clear(); }

private:
    std::vector<std::byte> drawn_, coming_;
    size_t texture_changes_ = 0; // as of the last call
};

} // namespace blush
