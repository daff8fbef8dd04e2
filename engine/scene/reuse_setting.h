// Special values of RenderSettings::reuse.
#pragma once

namespace blush {

constexpr int reuse_auto = 0; // decided for each image (render/pilots/reuse_choice.h)

} // namespace blush
