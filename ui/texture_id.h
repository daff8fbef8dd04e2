// An OpenGL texture as ImGui and its OpenGL backend name it.
#pragma once

#include <cstdint>
#include <epoxy/gl.h>
#include <imgui.h>

namespace blush {

inline ImTextureID texture_id(GLuint name) { return reinterpret_cast<ImTextureID>(uintptr_t(name)); }

} // namespace blush
