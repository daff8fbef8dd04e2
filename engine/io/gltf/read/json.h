// Checks the JSON of a glTF file before tinygltf, which trusts its input, parses it.
#pragma once

#include "core/result.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// The JSON text of a .gltf (the whole file) or a .glb (its first chunk, header and chunk lengths checked).
Result<std::string_view> gltf_json_text(std::span<const uint8_t> file_bytes);

// The binary chunk of a .glb that gltf_json_text has accepted; empty if there is none or for a .gltf.
std::span<const uint8_t> glb_binary(std::span<const uint8_t> file_bytes);

// A .glb of both chunks; an empty binary chunk is omitted. Empty if too large for a GLB (glTF 2.0, 4.4).
std::vector<uint8_t> glb_bytes(std::string text, std::vector<uint8_t> binary);

// Parses the text. Errors, each with its JSON path: nesting too deep for a recursive parser, an object with too many members for
// linear lookup, not JSON, not glTF 2.x, a required extension that is not supported, a buffer or image whose URI is not a file in
// or below `folder`.
Result<nlohmann::json> check_gltf_json(std::string_view text, const std::filesystem::path& folder);

} // namespace blush
