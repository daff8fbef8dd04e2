// Merged looks as display images, and an overview of them.
#pragma once

#include "app/commands/plan/merge_looks.h"
#include "color/color_management.h"

namespace blush {

// Writes display_file(): the merged image through the plan's view.
Result<void> write_display(const std::filesystem::path& folder, const RenderPlan& plan, const PlanLook& look, const ColorManagement& color);

// contact-sheet.png with at most 400 of the merged looks, small, row by row; contact-sheet.html with all, their names, settings and
// errors. `progress`: of all looks. Errors: cannot write.
Result<void> write_contact_sheet(const std::filesystem::path& folder, const RenderPlan& plan, const std::vector<LookProgress>& progress);

} // namespace blush
