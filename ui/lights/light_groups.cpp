#include "ui/lights/light_groups.h"

#include <algorithm>
#include <set>

namespace blush {

std::vector<std::string> group_names(const Scene& scene) {
    std::set<std::string> names{scene.environment.group};
    for (const auto& [id, node] : scene.nodes)
        if (const Light* light = scene.lights.find(node.light)) names.insert(light->group);
    names.erase("");
    return {names.begin(), names.end()};
}

std::string unused_group_name(const Scene& scene) {
    const std::vector<std::string> taken = group_names(scene);
    for (size_t n = 1;; ++n) {
        const std::string name = "Group " + std::to_string(n);
        if (!std::ranges::count(taken, name)) return name;
    }
}

} // namespace blush
