// Display transform on the GPU: from scene-linear frames to display values, with OCIO's shader, into a texture that ImGui draws.
#pragma once

#include "color/color_management.h"
#include "render/frame.h"
#include "ui/gl/gl_objects.h"
#include "ui/views/denoise_view.h"

#include <memory>
#include <vector>

namespace blush {

// All settings that can change without a new upload.
struct DisplayLook {
    DisplayParameters numbers;
    ImageMix mix;
    bool over_checker = false; // alpha is the opacity of premultiplied colours; transparent pixels show a checkerboard
    bool operator==(const DisplayLook&) const = default;
    bool needs_all_steps() const { return over_checker || numbers.needs_all_steps(); }
};

class DisplayPass {
public:
    // Compiles the display transform and uploads its lookup tables.
    Result<void> set_shader(const DisplayShader& shader);
    // Source pixels of the next image: a frame's or a denoised image's. They are copied while the image is drawn, and kept
    // alive until then. Must not be called while busy().
    void upload(const FramePtr& frame) { upload(frame->width, frame->height, {frame, frame->rgba.data()}); }
    void upload(int width, int height, std::vector<float> rgba) {
        upload(width, height, kept(std::move(rgba)));
    } // alpha: coverage by objects
    void upload(int width, int height, const std::shared_ptr<const std::vector<float>>& rgba) {
        upload(width, height, Values(rgba, rgba->data()));
    }
    void upload(const DenoisedPtr& denoised) {
        const DenoisedImage::Displayed displayed = denoised->displayed();
        upload_denoised(displayed.width, displayed.height, {denoised, displayed.rgb.data()});
    }
    void upload_denoised(int width, int height, const std::shared_ptr<const std::vector<float>>& rgb) {
        upload_denoised(width, height, Values(rgb, rgb->data()));
    }
    // Begins a new image from the last uploads; cancels one that is in progress. At the frame's resolution, or at that of an enlarged
    // denoised image (DenoisedImage::is_enlarged) if it is shown and drawing it is fast.
    void begin(const DisplayLook& look);
    // Continues for the given number of milliseconds, or slightly longer. A GPU finishes at once; with a software rasterizer a
    // large image takes several UI frames, without blocking any of them.
    void advance(double milliseconds);
    bool busy() const { return next_row_ < height_; }
    // Predicted milliseconds to upload and to draw this many pixels of one or both images, from the last measured speed.
    double expected_milliseconds(double pixels, int images) const {
        return pixels * images / uploading_.pixels_per_millisecond + pixels / drawing_.pixels_per_millisecond;
    }

    // The last finished image, first row on top.
    GLuint texture() const { return targets_[front_].texture(); }

private:
    using Values = std::shared_ptr<const float>;
    // Scene-linear pixels as a texture; they fill its lower left corner.
    struct SourceImage {
        GLenum format; // GL_RGB or GL_RGBA
        GlTexture texture = {};
        int room_width = 0, room_height = 0;
        int width = 0, height = 0;
        Values coming = {}; // null: all rows are uploaded
        int next_row = 0;
        void take(int w, int h, Values values);
        void upload_rows(int count);
    };
    // Measured speed of the last run.
    struct Pace {
        double pixels_per_millisecond;
        // Rows for the given time. At least one; at most `left`.
        int rows(double milliseconds, int width, int left) const;
    };
    static Values kept(std::vector<float> values);
    void upload(int width, int height, Values rgba);
    void upload_denoised(int width, int height, Values rgb);
    void step(double milliseconds);
    void draw_rows(int first, int count);

    GlProgram common_, complete_; // without and with the steps that most looks leave out (DisplayLook::needs_all_steps)
    GlVertexArray no_vertices_;
    SourceImage image_{GL_RGBA}, denoised_{GL_RGB};
    std::vector<std::pair<GLenum, GlTexture>> tables_; // in the texture units after those of the images
    RenderTarget targets_[2];                          // one is displayed while the other is drawn
    int front_ = 0;
    int width_ = 0, height_ = 0;
    int next_row_ = 0;
    Pace uploading_{1e5}, drawing_{1e4}; // conservative initial speeds
    DisplayLook look_;
};

} // namespace blush
