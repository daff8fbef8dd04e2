// From the choices of the Farm panel to the command line of `blush plan`.
#pragma once

#include "scene/view_settings.h"
#include "ui/views/farm_view.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace blush {

// What the choices apply to.
struct FarmSource {
    std::filesystem::path folder;         // for the plan
    std::vector<std::string> snapshots;   // files: the recipes from which the looks begin
    ViewSettings view = {};               // of the contact sheet; auto exposure is settled
    std::optional<size_t> animation = {}; // index of the clip that is chosen in the window
    unsigned threads = 0;                 // of the measurement; 0: one per core
};

// Without the name of the program.
std::vector<std::string> plan_arguments(const FarmChoices& choices, const FarmSource& source);

} // namespace blush
