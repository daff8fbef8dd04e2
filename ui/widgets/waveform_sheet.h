// The waveforms of the scopes as textures: ten thousand cells as rectangles would be slow with a software rasterizer.
#pragma once

#include "ui/gl/gl_objects.h"
#include "ui/views/scopes_view.h"

#include <imgui.h>

#include <vector>

namespace blush {

// RGBA bytes per cell, the highest level first: brightness is the pixel count of its column, per channel. Transparent if the
// count is zero.
std::vector<uint32_t> waveform_texels(const Waveform& waveform);

// The textures for the panel; 0 draws nothing.
struct WaveformTextures {
    ImTextureID scene = {}, displayed = {};
};

class WaveformSheet {
public:
    // Uploads the result if it has changed. Requires a current context.
    void update(const ScopesView& view);
    WaveformTextures textures() const;

private:
    GlTexture scene_, displayed_;
    uint64_t result_ = 0; // number of the uploaded result
};

} // namespace blush
