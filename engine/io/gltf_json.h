// What must hold of a glTF's JSON before a parser that trusts its input may see it.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace blush {

// The JSON text of a .gltf (the whole file) or a .glb (its first chunk, header and chunk lengths checked).
Result<std::string_view> gltf_json_text(std::span<const uint8_t> file_bytes);

// Errors, each with its JSON path: nested too deeply for a recursive reader, not JSON, not glTF 2.x, a required extension
// that is not supported, a buffer or image whose URI is not a file in or below `folder`.
Result<void> check_gltf_json(std::string_view text, const std::filesystem::path& folder);

} // namespace blush
