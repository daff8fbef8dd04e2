// Camera overlay of the viewport: passepartout and frame.
#pragma once

#include "ui/panel_context.h"
#include "ui/transform/gizmo.h"

#include <imgui.h>
#include <optional>

namespace blush {

// The camera's frame, if the image extends beyond it and is dimmed there; nullopt: nothing is dimmed.
std::optional<ImageRect> passepartout_of(const PanelContext& c, const ImageRect& image);
// Brightness of the image under the passepartout, of 255. An image that is drawn this dark needs no blending over it, which would
// take a tenth of a UI frame without a GPU.
constexpr int brightness_outside_frame = 105;

// In the camera view: passepartout, unless the image is `dimmed` already, and frame. In a free view, if there is a camera: the
// key that returns to it. `seen`: the visible part of the image.
void draw_camera_frame(PanelContext& c, ImDrawList& draw, const ImageRect& image, const ImageRect& seen, bool dimmed);

// The pixels of the camera's frame, if the image extends beyond it and the view is the camera's; nullopt: the frame is the
// whole image.
std::optional<PixelRect> camera_frame_of(const UiState& ui, const Scene& scene, const Frame& image);

// Moves the camera to the view's pose, if it is locked to the view.
void move_camera_to_view(PanelContext& c);

} // namespace blush
