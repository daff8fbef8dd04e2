// Films of frame sequences, by ffmpeg.
#pragma once

#include "app/commands/plan/render_plan.h"

namespace blush {

// MERGED/SEQUENCE.mp4 from the display images of its looks, all of which exist. Returns false, and does nothing, without ffmpeg in the
// path. Errors: ffmpeg fails, cannot write.
Result<bool> write_film(const std::filesystem::path& folder, const RenderPlan& plan, const std::string& sequence);

} // namespace blush
