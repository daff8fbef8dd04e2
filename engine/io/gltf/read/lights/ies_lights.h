// Internal to io/gltf: imports EXT_lights_ies. The extension lists profiles; the nodes that use them hold intensity factor and
// colour.
#pragma once

#include "io/gltf/read/context.h"

#include <map>
#include <optional>
#include <vector>

namespace blush {

// One light per distinct profile, factor and colour that reachable nodes use, sorted by profile, then by node.
struct IesLights {
    std::vector<std::optional<Light>> lights; // none if the profile cannot be read
    std::vector<int> profiles;                // by light: index of its profile
    std::map<int, size_t> by_node;            // node index to light
    std::map<int, float> peaks;               // profile index to peak candela, for profiles that were read
};

// `nodes`: indices of all nodes in scenes. A profile that cannot be read is a warning. Errors: a profile that does not exist.
Result<IesLights> read_ies_lights(const GltfContext& context, const std::vector<int>& nodes);

} // namespace blush
