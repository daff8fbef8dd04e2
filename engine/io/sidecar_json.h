// Edits that are not saved yet, as a text that outlives a crash.
#pragma once

#include "core/result.h"
#include "scene/edit.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace blush {

struct Sidecar {
    std::filesystem::path scene; // absolute
    std::string document_hash;   // hash_text of the scene file's JSON, which the edits belong to
    std::string edits;           // scene_edits_json.h
    RenderSettings render;
    ViewSettings view;
    bool operator==(const Sidecar&) const = default;
};

// {"format": 1, "scene": "/home/.../room.gltf", "document_hash": "...", "edits": {...}, "render": {...}, "display": {...}}
std::string sidecar_json(const Sidecar& sidecar);
// Errors: not such text, another format, settings that make no sense. Edits are checked when they are applied.
Result<Sidecar> parse_sidecar(std::string_view text);

// 64 bits (FNV-1a) as 16 hexadecimal digits: finds changes, not forgeries.
std::string hash_text(std::string_view text);

} // namespace blush
