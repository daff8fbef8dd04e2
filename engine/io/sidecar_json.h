// Edits that are not saved yet, as a text that outlives a crash.
#pragma once

#include "core/result.h"
#include "scene/edit.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

struct Sidecar {
    std::filesystem::path scene; // absolute
    std::string document_hash;   // hash_text of the scene file's JSON, which the edits belong to
    std::string edits;           // scene_edits_json.h
    std::string imported;        // records of the scene that was edited (scene_records_json.h); empty: not kept, for there are too many
    RenderSettings render;
    ViewSettings view;
    bool operator==(const Sidecar&) const = default;
};

// {"format": 1, "scene": "/home/.../room.gltf", "document_hash": "...", "edits": {...}, "imported": {...}, "render": {...}, "display": {...}}
std::string sidecar_json(const Sidecar& sidecar);
// Errors: not such text, another format, settings that make no sense. Edits are checked when they are applied.
Result<Sidecar> parse_sidecar(std::string_view text);

// Of the edits of `now` to what was imported from a file with that JSON. Scenes of more than 100 000 nodes keep no `imported`: it would be
// written again with each autosave.
Sidecar sidecar_of(const std::filesystem::path& file, std::string_view document_json, const Scene& imported, const Project& now);

// The project with the edits, where `file` is the scene as it is in the file now and `document_json` its JSON. If the file is not the one that was
// edited, edits are merged by name and path (merge_edits.h) and `conflicts` says what does not fit. Errors: edits that cannot be read; a file that
// changed since, where the sidecar has no records to compare it with.
struct RecoveredEdits {
    Project project;
    bool file_changed = false;
    std::vector<std::string> conflicts;
};
Result<RecoveredEdits> recover_edits(const Sidecar& sidecar, const Scene& file, std::string_view document_json);

// 64 bits (FNV-1a) as 16 hexadecimal digits: finds changes, not forgeries.
std::string hash_text(std::string_view text);

} // namespace blush
