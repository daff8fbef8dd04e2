// Conversion between OpenGL texture names and ImGui's texture ids.
#pragma once

#include <cstdint>
#include <epoxy/gl.h>
#include <imgui.h>

namespace blush {

inline ImTextureID texture_id(GLuint name) { return reinterpret_cast<ImTextureID>(uintptr_t(name)); }

} // namespace blush
