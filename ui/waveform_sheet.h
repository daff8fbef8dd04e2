// The waveforms of the scopes as textures: ten thousand cells drawn as rectangles would take a software rasteriser longer than all else.
#pragma once

#include "ui/gl_objects.h"
#include "ui/scopes_view.h"

#include <imgui.h>

#include <vector>

namespace blush {

// A cell's colour, RGBA in bytes, the highest level first: how many pixels of its column are there, channel by channel. Transparent where
// there are none.
std::vector<uint32_t> waveform_texels(const Waveform& waveform);

// What the panel draws from; 0 draws none.
struct WaveformTextures {
    ImTextureID scene = {}, displayed = {};
};

class WaveformSheet {
public:
    // Uploads an answer that is not the one it holds. Needs a current context once there is one.
    void update(const ScopesView& view);
    WaveformTextures textures() const;

private:
    GlTexture scene_, displayed_;
    uint64_t answer_ = 0; // the number of what they hold
};

} // namespace blush
