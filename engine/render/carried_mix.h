// Channels of the light mix go by the names of groups: an edit that changes what groups are called takes them along.
#pragma once

#include "scene/edit.h"

#include <optional>
#include <span>

namespace blush {

// What the mix must be after the edits so that each channel still scales the light that it scaled before: under the group's new name, or not
// there, if its lights are gone and others have taken over its name. Nothing if it is fine as it is, or if the edits are refused.
std::optional<LightMix> carried_mix(const Project& before, std::span<const Edit> edits);

} // namespace blush
