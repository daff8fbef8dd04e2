// The smoothness of the parts of a scene whose textures decide it, kept while these and the shape stay the same.
#pragma once

#include "render/compile/object_list.h"
#include "render/materials/smoothness.h"

#include <map>
#include <utility>
#include <vector>

namespace blush {

class PartSmoothness {
public:
    // `textured`: materials of `objects` with is_smooth_by_texture(), in id order. `changed`: materials that differ from those of the last
    // update, or null: all may, and their textures. Returns true if some smoothness differs from before.
    bool update(const Scene& scene, const std::vector<SceneObject>& objects, const std::vector<Id<Material>>& textured,
                const std::vector<Id<Material>>* changed, const MaterialTable& table);

    // Of any part of the objects.
    Smoothness of(const MeshPart& part, const Material& material) const;
    // The largest shares of all parts with textures.
    const Smoothness& largest() const { return largest_; }

private:
    using Key = std::pair<uint64_t, Id<Material>>; // the serial of the geometry
    std::map<Key, Smoothness> of_part_;
    Smoothness largest_;
};

} // namespace blush
