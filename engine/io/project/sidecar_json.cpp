#include "io/project/sidecar_json.h"

#include "io/project/json_fields.h"
#include "io/project/merge_edits.h"
#include "io/project/scene_edits_json.h"
#include "io/project/scene_records_json.h"
#include "io/project/settings_json.h"

namespace blush {
namespace {

constexpr int sidecar_format_version = 1;
constexpr size_t max_kept_nodes = 100'000;

} // namespace

std::string sidecar_json(const Sidecar& s) {
    Json json{{"format", sidecar_format_version},
              {"scene", s.scene.string()},
              {"document_hash", s.document_hash},
              {"edits", Json::parse(s.edits)},
              {"render", Json::parse(render_settings_json(s.render))},
              {"display", Json::parse(view_settings_json(s.view))}};
    if (!s.imported.empty()) json["imported"] = Json::parse(s.imported);
    return json_text(json);
}

Result<Sidecar> parse_sidecar(std::string_view text) {
    const Result<Json> json = parse_json_object(text);
    if (!json) return json.error();
    int format = 0;
    std::string scene;
    Sidecar s;
    const auto has = [&](const char* key) { return json->contains(key) && (*json)[key].is_object(); };
    if (!json->contains("format") || !read_json((*json)["format"], format) || format != sidecar_format_version)
        return Error{"", fmt::format("a recovery file of a format other than {}", sidecar_format_version), "format"};
    if (!json->contains("scene") || !read_json((*json)["scene"], scene) || !json->contains("document_hash") ||
        !read_json((*json)["document_hash"], s.document_hash) || !has("edits") || !has("render") || !has("display"))
        return Error{"", "incomplete recovery file", ""};
    s.scene = scene;
    s.edits = json_text((*json)["edits"]);
    if (has("imported")) s.imported = json_text((*json)["imported"]);
    const auto render = parse_render_settings(json_text((*json)["render"]));
    if (!render) return render.error();
    const auto view = parse_view_settings(json_text((*json)["display"]));
    if (!view) return view.error();
    s.render = render->settings;
    s.view = view->settings;
    return s;
}

Sidecar sidecar_of(const std::filesystem::path& file, std::string_view document_json, const Scene& imported, const Project& now) {
    Sidecar s{file, hash_text(document_json), edits_json(imported, now.scene), {}, now.render, now.view};
    if (imported.nodes.size() <= max_kept_nodes) s.imported = records_json(imported);
    return s;
}

Result<RecoveredEdits> recover_edits(const Sidecar& sidecar, const Scene& file, std::string_view document_json) {
    const std::filesystem::path folder = sidecar.scene.parent_path();
    RecoveredEdits recovered{{{}, sidecar.render, sidecar.view}, hash_text(document_json) != sidecar.document_hash, {}};
    if (!recovered.file_changed) {
        Result<Scene> edited = apply_edits_json(file, sidecar.edits, folder);
        if (!edited) return edited.error();
        recovered.project.scene = *std::move(edited);
        return recovered;
    }
    if (sidecar.imported.empty())
        return Error{
            "", "has changed since, and the recovery file lacks its former contents: restore the former version to recover the edits", ""};
    const Result<Scene> base = scene_of_records(sidecar.imported, file);
    if (!base) return base.error();
    const Result<Scene> mine = apply_edits_json(*base, sidecar.edits, folder);
    if (!mine) return mine.error();
    MergedEdits merged = merge_edits(*base, *mine, file);
    recovered.project.scene = std::move(merged.scene);
    recovered.conflicts = std::move(merged.conflicts);
    return recovered;
}

std::string hash_text(std::string_view text) {
    uint64_t hash = 0xcbf29ce484222325u; // Fowler, Noll, Vo: offset basis and prime of 64 bits
    for (const char c : text) hash = (hash ^ uint8_t(c)) * 0x100000001b3u;
    return fmt::format("{:016x}", hash);
}

} // namespace blush
