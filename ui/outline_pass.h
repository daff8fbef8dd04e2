// A thin line around the selected objects, found in the frame's id plane: no ray is traced for it.
#pragma once

#include "render/frame.h"
#include "scene/picture_region.h"
#include "ui/gl_objects.h"

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

class OutlinePass {
public:
    Result<void> load();
    // Takes from the id plane where the selected objects are: those whose selected[Id<Node>.value] is not 0. A frame without
    // that plane gives no outline, nor one in which none of them is seen.
    void upload(const Frame& frame, const std::vector<uint8_t>& selected);
    // Makes texture() the line over a picture that is so large on the screen, see-through elsewhere. It does not depend on the picture's colours:
    // nothing is done where the last one will do.
    void draw(int width, int height, float thickness);

    GLuint texture() const { return target_.texture(); }
    // Where the line may be, in pixels of the frame that was uploaded; the rest of the texture need not be shown.
    std::span<const PixelRect> edges() const { return edges_; }
    int frame_width() const { return width_; }
    int frame_height() const { return height_; }

private:
    GlProgram program_;
    GlVertexArray no_vertices_;
    GlTexture mask_;
    std::vector<uint8_t> inside_, coming_; // coming_: kept for its memory
    RenderTarget target_;
    int width_ = 0, height_ = 0;
    std::vector<PixelRect> edges_;
    float thickness_ = 0; // of the line that is in the target; 0: it shows another mask
};

} // namespace blush
