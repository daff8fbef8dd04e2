// The picture with a thin line around the selected objects, found in the frame's id plane: no ray is traced for it.
#pragma once

#include "render/frame.h"
#include "scene/picture_region.h"
#include "ui/gl_objects.h"

#include <cstdint>
#include <vector>

namespace blush {

class OutlinePass {
public:
    Result<void> load();
    // Takes from the id plane where the selected objects are: those whose selected[Id<Node>.value] is not 0. A frame without
    // that plane gives no outline, nor one in which none of them is seen.
    void upload(const Frame& frame, const std::vector<uint8_t>& selected);
    // `picture` with the outline, as large as it is on the screen. Drawn once for many frames of the window: a transparent layer
    // over the picture would be blended anew in each.
    void draw(GLuint picture, int width, int height, float thickness);

    GLuint texture() const { return target_.texture(); }
    bool empty() const { return edges_.empty(); }

private:
    GlProgram program_;
    GlVertexArray no_vertices_;
    GlTexture mask_;
    std::vector<uint8_t> inside_;
    RenderTarget target_;
    int width_ = 0, height_ = 0;
    std::vector<PixelRect> edges_; // where the line may be, in the frame's pixels
};

} // namespace blush
