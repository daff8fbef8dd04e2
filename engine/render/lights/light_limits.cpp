#include "render/lights/light_limits.h"

#include <algorithm>

namespace blush {

int disk_corners(const Scene& scene, const std::vector<Id<Node>>& nodes) {
    const auto disks = std::ranges::count_if(
        nodes, [&](Id<Node> id) { return scene.lights.find(scene.nodes.find(id)->light)->kind == Light::Kind::disk; });
    const auto fits = std::ranges::find_if(disk_corner_choices, [&](int corners) { return disks * corners <= max_mesh_lights; });
    return fits == disk_corner_choices.end() ? disk_corner_choices.back() : *fits;
}

} // namespace blush
