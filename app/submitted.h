// What the render session was last given, which the project is compared with.
#pragma once

#include "render/film_planes.h"
#include "scene/render_settings.h"
#include "scene/scene.h"

#include <cstdint>

namespace blush {

class Submitted {
public:
    // The revision that the window waits for; 0: nothing yet.
    uint64_t revision() const { return revision_; }
    const RenderSettings& settings() const { return settings_; }
    // Whatever comes next is new.
    void forget() { revision_ = 0; }

    bool is_new(const Scene& scene, const RenderSettings& settings, PlaneSet planes) const;
    // Does the session work at the very image of these?
    bool is_same_image(const Scene& scene, const RenderSettings& settings) const;
    // The revision that these are given under.
    uint64_t note(const Scene& scene, const RenderSettings& settings, PlaneSet planes);

private:
    uint64_t last_ = 0; // of all that were given out
    uint64_t revision_ = 0;
    Scene scene_;
    RenderSettings settings_;
    PlaneSet planes_;
};

} // namespace blush
