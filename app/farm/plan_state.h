// How a plan stands, for the Farm panel: from its folder alone, whatever runs it.
#pragma once

#include "ui/views/farm_view.h"

#include <filesystem>

namespace blush {

// Reads plan.json, the records of parts and merged images, and logs: not the images. Asks Slurm if the plan was submitted to it.
FarmPlan read_farm_plan(const std::filesystem::path& folder);

// The merged image of a look, which may not be there yet.
std::filesystem::path merged_image(const FarmPlan& plan, const FarmLook& look);

} // namespace blush
