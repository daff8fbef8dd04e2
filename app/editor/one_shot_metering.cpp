#include "app/editor/one_shot_metering.h"

#include "ui/views/subject_exposure.h"

#include <cmath>

namespace blush {

void OneShotMetering::want(const Project& project, bool opening) {
    // An environment chosen before the image was metered belongs to the opening.
    due_ = Due{opening || (due_ && due_->opening), project.view.exposure_ev, project.scene.environment};
}

void OneShotMetering::update(Document& document, const FramePtr& frame, const UiState& ui, const ColorManagement& color) {
    if (!due_ || !frame) return;
    const Project& project = document.project();
    const bool taken_back =
        project.scene.environment.kind != due_->environment.kind || project.scene.environment.image != due_->environment.image;
    if (project.view.auto_exposure != AutoExposure::off || project.view.exposure_ev != due_->exposure_ev || taken_back) return due_.reset();
    const int64_t paths = frame->samples * frame->width * frame->height;
    if (frame->divider != 1 || (paths < paths_to_meter && !frame->complete)) return;
    const auto metered = subject_exposure(*frame, project.scene, ui.selection(project.scene), project.view, color);
    // Rounded to tenths, so that noise of few samples does not change the value.
    if (metered) document.meter(std::round(*metered * 10) / 10 + 0.f, due_->opening);
    due_.reset();
}

} // namespace blush
