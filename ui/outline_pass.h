// A thin line around the selected object, found in the frame's id plane: no ray is traced for it.
#pragma once

#include "render/frame.h"
#include "ui/gl_objects.h"

namespace blush {

class OutlinePass {
public:
    Result<void> load();
    // Takes over the id plane; a frame without one gives no outline.
    void upload(const Frame& frame);
    // The outline of an object (Id<Node>.value) over a transparent ground, for a picture width x height pixels on the screen.
    void draw(uint32_t object, int width, int height, float thickness);

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
