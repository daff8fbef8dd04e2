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
    // Takes over a frame's pixels. Not while busy.
    void upload(const Frame& frame);
    // Begins a new picture of the last upload, at the frame's resolution; exposure and gamma cost nothing else. Not while busy.
    void begin(float exposure_ev, float gamma);
    // Goes on with it for about so many milliseconds. A graphics card is done at once; where the processor stands in for one, a large
    // picture takes several of the window's frames, none of which it may hold up.
    void advance(double milliseconds);
    bool busy() const { return next_row_ < height_; }

    // The last finished picture, first row on top.
    GLuint texture() const { return targets_[front_].texture(); }

private:
    void draw_rows(int first, int count);

    GlProgram program_;
    GlVertexArray no_vertices_;
    GlTexture image_;
    std::vector<std::pair<GLenum, GlTexture>> tables_; // in texture units 1, 2, ...
    RenderTarget targets_[2];                          // one is shown while the other is drawn
    int front_ = 0;
    int image_width_ = 0, image_height_ = 0; // of the texture; the frame fills its lower left corner
    int width_ = 0, height_ = 0;
    int next_row_ = 0;
    double rows_per_millisecond_ = 16; // measured; a careful guess at first
    float exposure_ev_ = 0, gamma_ = 1;
};

} // namespace blush
