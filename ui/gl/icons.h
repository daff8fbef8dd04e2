// Icons drawn as strokes, so that they are sharp at every scale.
#pragma once

#include "scene/scene.h"

#include <imgui.h>

namespace blush {

enum class Icon {
    point,
    spot,
    sun,
    rectangle,
    disk,
    sphere,
    mesh,
    group,
    camera,
    folder,
    file,
    eye,
    eye_closed,
    arrow_up,
    play,
    pause,
    move,
    rotate,
    scale,
    world_axes,
    local_axes
};

Icon icon_of(Light::Kind kind);

// `size` is the side of the square around `centre` that the icon fills.
void draw_icon(ImDrawList& draw, Icon icon, ImVec2 centre, float size, ImU32 color);

// The icon as an ImGui item on the current line, vertically centred.
void icon_item(Icon icon, ImU32 color, float height);

// A square, frameless button, as high as a field.
bool icon_button(const char* id, Icon icon, ImU32 color);

} // namespace blush
