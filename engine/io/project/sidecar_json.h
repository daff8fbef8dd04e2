// Recovery file: unsaved edits as JSON, to restore them after a crash.
#pragma once

#include "core/result.h"
#include "scene/document/edit.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

struct Sidecar {
    std::filesystem::path scene; // absolute
    std::string document_hash;   // hash_text of the JSON of the scene file at the time of the edits
    std::string edits;           // scene_edits_json.h
    std::string imported;        // records of the scene as imported (scene_records_json.h); empty if too many
    RenderSettings render;
    ViewSettings view;
    bool operator==(const Sidecar&) const = default;
};

// {"format": 1, "scene": "/home/.../room.gltf", "document_hash": "...", "edits": {...}, "imported": {...}, "render": {...}, "display":
// {...}}
std::string sidecar_json(const Sidecar& sidecar);
// Errors: invalid text, another format, invalid settings. Edits are checked when they are applied.
Result<Sidecar> parse_sidecar(std::string_view text);

// Recovery data for the edits from `imported` to `now`. Above 100 000 nodes `imported` stays empty, since every autosave would
// write it again.
Sidecar sidecar_of(const std::filesystem::path& file, std::string_view document_json, const Scene& imported, const Project& now);

// Applies the edits to `file`, the scene in the file now, whose JSON is `document_json`. If the file has changed, edits are
// merged by name and path (merge_edits.h) with `conflicts`. Errors: edits that cannot be read; a changed file if the sidecar has
// no `imported` records.
struct RecoveredEdits {
    Project project;
    bool file_changed = false;
    std::vector<std::string> conflicts;
};
Result<RecoveredEdits> recover_edits(const Sidecar& sidecar, const Scene& file, std::string_view document_json);

// FNV-1a, 64 bits as 16 hexadecimal digits. Not cryptographic.
std::string hash_text(std::string_view text);

} // namespace blush
