#include "app/editor/last_submission.h"

#include "scene/changes.h"

namespace blush {

bool LastSubmission::is_new(const Scene& scene, const RenderSettings& settings, PlaneSet planes) const {
    return revision_ == 0 || planes != planes_ || diff(scene_, settings_, scene, settings).any();
}

bool LastSubmission::is_same_image(const Scene& scene, const RenderSettings& settings) const {
    return revision_ != 0 && !diff(scene_, settings_, scene, settings).affects_image();
}

uint64_t LastSubmission::note(const Scene& scene, const RenderSettings& settings, PlaneSet planes) {
    scene_ = scene;
    settings_ = settings;
    planes_ = planes;
    return revision_ = ++last_;
}

} // namespace blush
