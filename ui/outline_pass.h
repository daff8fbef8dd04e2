// The picture with a thin line around the selected object, found in the frame's id plane: no ray is traced for it.
#pragma once

#include "render/frame.h"
#include "ui/gl_objects.h"

namespace blush {

class OutlinePass {
public:
    Result<void> load();
    // Takes over the id plane; a frame without one gives no outline.
    void upload(const Frame& frame);
    // `picture` with the outline of an object (Id<Node>.value), as large as it is on the screen. Drawn once for many frames of the
    // window: a transparent layer over the picture would be blended anew in each.
    void draw(GLuint picture, uint32_t object, int width, int height, float thickness);

    GLuint texture() const { return target_.texture(); }
    bool empty() const { return width_ == 0; }

private:
    GlProgram program_;
    GlVertexArray no_vertices_;
    GlTexture ids_;
    RenderTarget target_;
    int width_ = 0, height_ = 0;
};

} // namespace blush
