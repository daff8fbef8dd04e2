// The pixels and the caption of a view of a frame.
#pragma once

#include "render/frame.h"
#include "ui/snapshots/image_view.h"

#include <span>
#include <string>
#include <vector>

namespace blush {

// True if the frame has the required planes and the view is not just the beauty.
bool is_special(const Frame& frame, const ImageView& view);
// width * height * 4 scene-linear values of a special view. Heat maps go from black over blue, red and yellow to white.
std::vector<float> pixels_of(const Frame& frame, const ImageView& view);
// `rgba` with the coverage by objects (coverage.h) as alpha.
std::vector<float> with_coverage(const Frame& frame, std::vector<float> rgba);
// True if the light mix changes the gain of any group; the bounce planes do not include the mix.
bool is_mixed(std::span<const Vec3> gains);
// One-line caption of a special view; it also says that this is not the whole image.
std::string caption_of(const Frame& frame, const ImageView& view);

} // namespace blush
