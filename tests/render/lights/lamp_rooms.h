// Lamps in a room, compiled, and tiles rendered with clearance boxes and without.
#pragma once

#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "tests/render/lights/lamp_shapes.h"
#include "tests/render/rendered_image.h"

#include <vector>

namespace blush::test {

Transform stretched(const Vec3& position, const Vec3& scale);
Material glow(bool two_sided = false);
// A room with things in it, seen from its open side.
Scene room();

struct CompiledLamps {
    RenderSettings settings;
    Workers workers{1};
    Scene expanded;
    RenderScene scene;

    explicit CompiledLamps(const Scene& s);
    void follow(const Scene& edited);
    // The boxes of all lamps; empty: no lamp stands clear.
    std::vector<ClearanceBox> boxes() const;
    // By lamp: whether it stands clear.
    std::vector<bool> clear() const;
    int64_t numbered_records() const;
    // Radiance of every sample; `whole_rays`: shadow rays end at the lamps, not before them.
    std::vector<double> render(bool whole_rays) const;
};

} // namespace blush::test
