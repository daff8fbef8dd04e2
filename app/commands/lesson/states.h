// The states of the window that the steps of a lesson ask for.
#pragma once

#include "app/commands/lesson/lesson_file.h"
#include "scene/document/edit.h"

#include <atomic>
#include <vector>

namespace blush {

class Progress;

// The default size of images of which claims speak.
constexpr int claim_width = 160, claim_height = 90;

// The view settings that the window shows a step with: it meters exposure unless the step sets one.
ViewSettings view_in_window(const LessonStep& step, ViewSettings view);

// The project of each step, without `size` in a window that has its own. Each scene is read once. Errors, with FILE:LINE: a scene that
// cannot be read, an unknown camera, a claim about pixels outside of the image.
Result<std::vector<Project>> states_of(const Lesson& lesson, Progress& progress, const std::atomic<bool>& interrupted);

} // namespace blush
