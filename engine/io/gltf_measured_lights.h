// Internal to gltf_*.cpp: EXT_lights_ies, luminaires as they were measured. A profile is in a list; how bright it shines and in which colour
// is said by the nodes that name it.
#pragma once

#include "io/gltf_source.h"

#include <map>
#include <optional>
#include <vector>

namespace blush {

// One light for each profile, factor and colour that reachable nodes ask for, in the order of profiles, then of nodes.
struct MeasuredLights {
    std::vector<std::optional<Light>> lights; // none where its profile cannot be read
    std::vector<int> profiles;                // by light: index of its profile
    std::map<int, size_t> by_node;            // by index of the node: its light
    std::map<int, float> peaks;               // by index of the profile: its largest candela; of those that were read
};

// `nodes`: indices of those that are shown. A profile that cannot be read is a warning. Errors: a profile that does not exist.
Result<MeasuredLights> read_measured_lights(const GltfContext& context, const std::vector<int>& nodes);

} // namespace blush
