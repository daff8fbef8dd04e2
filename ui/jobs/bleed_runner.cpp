#include "ui/jobs/bleed_runner.h"

namespace blush {
namespace {

constexpr double good_error = 0.003; // of the whole (BleedReport::error)
// Student's interval of few groups of batches is not reliable; and an error that does not fall.
constexpr int64_t least_paths = 32 * bleed_batch_paths, most_paths = int64_t(1) << 22;

} // namespace

BleedWork::Input::Input(const Scene& scene_, const RenderSettings& settings_, const BleedTarget& target_)
    : ImageInput{scene_, settings_}, target(target_) {
    settings.resolution_scale = 1;
    settings.region = {};
    if (target.kind == BleedTarget::Kind::pixels) return;
    settings.width = settings.height = 1;
    // Light that arrives does not depend on the camera.
    if (target.kind == BleedTarget::Kind::incoming) scene.view = {};
}

bool BleedWork::Input::has_same_result(const Input& other) const { return target == other.target && ImageInput::has_same_result(other); }

bool BleedWork::is_good(const Output& report) {
    return !report || !report->lit || report->paths >= most_paths || (report->paths >= least_paths && report->error() <= good_error);
}

} // namespace blush
