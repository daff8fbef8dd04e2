// From scene-linear frames to what the display shows: OCIO's shader over a float texture, into one that ImGui draws.
#pragma once

#include "color/color_management.h"
#include "render/frame.h"
#include "ui/denoise_view.h"
#include "ui/gl_objects.h"

#include <vector>

namespace blush {

// All that can be changed about a picture without another upload.
struct DisplayLook {
    DisplayNumbers numbers;
    PictureMix mix;
    bool operator==(const DisplayLook&) const = default;
};

class DisplayPass {
public:
    // Compiles the display transform and uploads its tables.
    Result<void> set_shader(const DisplayShader& shader);
    // Takes over a frame's pixels, or a denoised picture's. Not while busy.
    void upload(const Frame& frame) { upload(frame.width, frame.height, frame.rgba); }
    void upload(int width, int height, const std::vector<float>& rgba); // scene-linear; alpha: coverage by objects
    void upload(const DenoisedPicture& denoised) { upload_denoised(denoised.width, denoised.height, denoised.denoised.rgb); }
    void upload_denoised(int width, int height, const std::vector<float>& rgb); // 3 values a pixel
    // Begins a new picture of the last uploads, at the frame's resolution; one that is being drawn is given up.
    void begin(const DisplayLook& look);
    // Goes on with it for about so many milliseconds. A graphics card is done at once; where the processor stands in for one, a large
    // picture takes several of the window's frames, none of which it may hold up.
    void advance(double milliseconds);
    bool busy() const { return next_row_ < height_; }

    // The last finished picture, first row on top.
    GLuint texture() const { return targets_[front_].texture(); }

private:
    // Scene-linear pixels as a texture, of which they fill the lower left corner.
    struct Picture {
        GlTexture texture;
        int room_width = 0, room_height = 0;
        int width = 0, height = 0;
        void upload(int w, int h, GLenum format, const float* values);
    };
    void draw_rows(int first, int count);

    GlProgram program_;
    GlVertexArray no_vertices_;
    Picture image_, denoised_;
    std::vector<std::pair<GLenum, GlTexture>> tables_; // in the texture units after those of the pictures
    RenderTarget targets_[2];                          // one is shown while the other is drawn
    int front_ = 0;
    int width_ = 0, height_ = 0;
    int next_row_ = 0;
    double rows_per_millisecond_ = 16; // measured; a careful guess at first
    DisplayLook look_;
};

} // namespace blush
