// From scene-linear frames to what the display shows: OCIO's shader over a float texture, into one that ImGui draws.
#pragma once

#include "color/color_management.h"
#include "render/frame.h"
#include "ui/gl_objects.h"

#include <vector>

namespace blush {

class DisplayPass {
public:
    // Compiles the display transform and uploads its tables.
    Result<void> set_shader(const DisplayShader& shader);
    // Takes over a frame's pixels.
    void upload(const Frame& frame);
    // Runs the shader over the last upload, at the frame's resolution; exposure and gamma cost nothing else.
    void draw(float exposure_ev, float gamma);

    // The finished picture, first row on top.
    GLuint texture() const { return target_.texture(); }

private:
    GlProgram program_;
    GlVertexArray no_vertices_;
    GlTexture image_;
    std::vector<std::pair<GLenum, GlTexture>> tables_; // in texture units 1, 2, ...
    RenderTarget target_;
    int width_ = 0, height_ = 0;
};

} // namespace blush
