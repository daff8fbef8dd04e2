// The last submission to the render session, for comparison with the project.
#pragma once

#include "render/film/film_size.h"
#include "scene/render_settings.h"
#include "scene/scene.h"

#include <cstdint>

namespace blush {

class LastSubmission {
public:
    // The revision that the window expects; 0: none yet.
    uint64_t revision() const { return revision_; }
    const RenderSettings& settings() const { return settings_; }
    // The next call of is_new() returns true.
    void forget() { revision_ = 0; }

    bool is_new(const Scene& scene, const RenderSettings& settings, PlaneSet planes) const;
    // True if these give the image that the session renders.
    bool is_same_image(const Scene& scene, const RenderSettings& settings) const;
    // Records the submission and returns its revision.
    uint64_t note(const Scene& scene, const RenderSettings& settings, PlaneSet planes);

private:
    uint64_t last_ = 0; // of all revisions so far
    uint64_t revision_ = 0;
    Scene scene_;
    RenderSettings settings_;
    PlaneSet planes_;
};

} // namespace blush
