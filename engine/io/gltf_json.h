// What must hold of a glTF's JSON before a parser that trusts its input may see it.
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

// The second chunk of a .glb whose chunks gltf_json_text has accepted; empty if it has none or is a .gltf.
std::span<const uint8_t> glb_binary(std::span<const uint8_t> file_bytes);

// A .glb of both chunks, the second left out if it is empty; empty for more than a GLB can hold (glTF 2.0, 4.4).
std::vector<uint8_t> glb_bytes(std::string text, std::vector<uint8_t> binary);

// The parsed text. Errors, each with its JSON path: nested too deeply for a recursive reader, an object of more members than one that keeps
// their order can look up in reasonable time, not JSON, not glTF 2.x, a required extension that is not supported, a buffer or image whose
// URI is not a file in or below `folder`.
Result<nlohmann::json> check_gltf_json(std::string_view text, const std::filesystem::path& folder);

} // namespace blush
