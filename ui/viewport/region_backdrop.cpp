#include "ui/viewport/region_backdrop.h"

#include "ui/gl/texture_id.h"
#include "ui/snapshots/image_pixels.h"

namespace blush {
namespace {

constexpr double backdrop_frame = 16; // milliseconds per UI frame, as for the image itself
constexpr ImU32 dimmed = IM_COL32(105, 105, 105, 255);

} // namespace

std::array<ImageRegion, 4> around(const ImageRegion& r) {
    const float right = r.x + r.width, bottom = r.y + r.height;
    return {{{0, 0, 1, r.y}, {0, bottom, 1, 1 - bottom}, {0, r.y, r.x, r.height}, {right, r.y, 1 - right, r.height}}};
}

void RegionBackdrop::set_shader(const DisplayShader& shader) {
    shader_ = shader;
    shader_changed_ = true;
}

void RegionBackdrop::remember(const FramePtr& frame, const DenoisedPtr& denoised) {
    if (!frame || !frame->whole) return;
    frame_ = frame;
    denoised_ = denoised;
    drawn_ = false;
}

void RegionBackdrop::forget() {
    frame_.reset();
    denoised_.reset();
    shown_ = {};
    drawn_ = false;
}

bool RegionBackdrop::update(const DisplayLook& look, const ImageView& view, const FrameBudget& pace) {
    if (!frame_ || !shader_) return true;
    const bool special = is_special(*frame_, view);
    Shown wanted{frame_, look, view};
    if (special || !denoised_) wanted.look.mix = {};
    if (shader_changed_ && !pass_.set_shader(*shader_)) return true; // the display pass of the image has already reported the error
    if (shader_changed_ || (!pass_.busy() && shown_ != wanted)) {
        if (special)
            pass_.upload(frame_->width, frame_->height, pixels_of(*frame_, view));
        else
            pass_.upload(frame_);
        if (wanted.look.mix.denoised_weight != 0) pass_.upload(denoised_);
        pass_.begin(wanted.look);
        shown_ = wanted;
    }
    shader_changed_ = false;
    pass_.advance(pace.left(backdrop_frame, FrameBudget::Clock::now()));
    drawn_ = drawn_ || !pass_.busy();
    return !pass_.busy();
}

void RegionBackdrop::draw(ImDrawList& draw, const ImageRect& image, const ImageRegion& region) const {
    for (const ImageRegion& part : around(region)) {
        if (part.width <= 0 || part.height <= 0) continue;
        const ImVec2 low{image.x + part.x * image.width, image.y + part.y * image.height};
        const ImVec2 high{low.x + part.width * image.width, low.y + part.height * image.height};
        draw.AddImage(texture_id(pass_.texture()), low, high, {part.x, part.y}, {part.x + part.width, part.y + part.height}, dimmed);
    }
}

} // namespace blush
