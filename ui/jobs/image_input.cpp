#include "ui/jobs/image_input.h"

#include "scene/changes.h"

namespace blush {

bool ImageInput::has_same_result(const ImageInput& other) const {
    return !diff(scene, settings, other.scene, other.settings).affects_image();
}

} // namespace blush
