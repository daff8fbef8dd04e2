// Outline of the selected objects, computed from the frame's id plane; no rays are traced.
#pragma once

#include "render/frame.h"
#include "scene/image_region.h"
#include "ui/gl/gl_objects.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

class OutlinePass {
public:
    Result<void> load();
    // Makes the mask of the selected objects from the id plane: those with selected[Id<Node>.value] != 0. No outline if the frame
    // has no id plane, or none of the objects is visible.
    void upload(const Frame& frame, const std::vector<uint8_t>& selected);
    // Renders the outline into texture() for an image of this size on the screen; transparent elsewhere. It does not depend on
    // the image's colours. Skipped if the last outline is still valid.
    void draw(int width, int height, float thickness);

    GLuint texture() const { return target_.texture(); }
    // Regions that can contain the line, in pixels of the uploaded frame; the rest of the texture can be skipped.
    std::span<const PixelRect> edges() const { return edges_; }
    int frame_width() const { return width_; }
    int frame_height() const { return height_; }

private:
    GlProgram program_;
    GlVertexArray no_vertices_;
    GlTexture mask_;
    std::vector<uint8_t> inside_, coming_; // coming_: reused buffer
    RenderTarget target_;
    int width_ = 0, height_ = 0;
    std::vector<PixelRect> edges_;
    float thickness_ = 0; // of the line in the target; 0: it shows an outdated mask
};

} // namespace blush
