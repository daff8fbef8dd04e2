#include "render/compile/part_smoothness.h"

#include <algorithm>

namespace blush {

bool PartSmoothness::update(const Scene& scene, const std::vector<SceneObject>& objects, const std::vector<Id<Material>>& textured,
                            const std::vector<Id<Material>>* changed, const MaterialTable& table) {
    const std::map<Key, Smoothness> before = std::move(of_part_);
    of_part_.clear();
    largest_ = {};
    if (textured.empty()) return !before.empty();
    for (const SceneObject& object : objects)
        for (const MeshPart& part : object.parts) {
            if (!std::ranges::binary_search(textured, part.material)) continue;
            const Key key{part.geometry->serial, part.material};
            if (of_part_.contains(key)) continue;
            const auto known = before.find(key);
            const bool same = known != before.end() && changed && std::ranges::find(*changed, part.material) == changed->end();
            const Smoothness found =
                same ? known->second : smoothness_of(*part.geometry, *scene.materials.find(part.material), part.material, table);
            of_part_.emplace(key, found);
            largest_ = largest_of(largest_, found);
        }
    return of_part_ != before;
}

Smoothness PartSmoothness::of(const MeshPart& part, const Material& material) const {
    const auto found = of_part_.find({part.geometry->serial, part.material});
    return found != of_part_.end() ? found->second : smoothness_of(material);
}

} // namespace blush
