// Keeps channels of the light mix attached to their groups when an edit renames groups.
#pragma once

#include "scene/document/edit.h"

#include <optional>
#include <span>

namespace blush {

// Returns the mix after the edits, such that each channel still scales the same light: under the group's new name, or removed if
// its lights are gone and other lights now use the name. Empty if no change is needed or if the edits are rejected.
std::optional<LightMix> rename_mix_channels(const Project& before, std::span<const Edit> edits);

} // namespace blush
