#include "io/sidecar_json.h"

#include "io/json_fields.h"
#include "io/settings_json.h"

namespace blush {
namespace {

constexpr int format_version = 1;

} // namespace

std::string sidecar_json(const Sidecar& s) {
    return json_text({{"format", format_version},
                      {"scene", s.scene.string()},
                      {"document_hash", s.document_hash},
                      {"edits", Json::parse(s.edits)},
                      {"render", Json::parse(render_settings_json(s.render))},
                      {"display", Json::parse(view_settings_json(s.view))}});
}

Result<Sidecar> parse_sidecar(std::string_view text) {
    const Result<Json> json = parse_json_object(text);
    if (!json) return json.error();
    int format = 0;
    std::string scene;
    Sidecar s;
    const auto has = [&](const char* key) { return json->contains(key) && (*json)[key].is_object(); };
    if (!json->contains("format") || !read_json((*json)["format"], format) || format != format_version)
        return Error{"", fmt::format("a recovery file of a format other than {}", format_version), "format"};
    if (!json->contains("scene") || !read_json((*json)["scene"], scene) || !json->contains("document_hash") ||
        !read_json((*json)["document_hash"], s.document_hash) || !has("edits") || !has("render") || !has("display"))
        return Error{"", "not a whole recovery file", ""};
    s.scene = scene;
    s.edits = json_text((*json)["edits"]);
    const auto render = parse_render_settings(json_text((*json)["render"]));
    if (!render) return render.error();
    const auto view = parse_view_settings(json_text((*json)["display"]));
    if (!view) return view.error();
    s.render = render->settings;
    s.view = view->settings;
    return s;
}

std::string hash_text(std::string_view text) {
    uint64_t hash = 0xcbf29ce484222325u; // Fowler, Noll, Vo: offset basis and prime of 64 bits
    for (const char c : text) hash = (hash ^ uint8_t(c)) * 0x100000001b3u;
    return fmt::format("{:016x}", hash);
}

} // namespace blush
