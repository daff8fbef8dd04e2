#include "app/commands/plan/gather.h"

#include "app/common/output_folder.h"
#include "io/gltf/read/uri.h"
#include "io/project/json_fields.h"

#include <fmt/format.h>

#include <set>
#include <vector>

namespace blush {
namespace {

Result<void> copy_into(const std::filesystem::path& file, const std::filesystem::path& copy) {
    std::error_code code;
    std::filesystem::create_directories(copy.parent_path(), code);
    if (!code) std::filesystem::copy_file(file, copy, std::filesystem::copy_options::overwrite_existing, code);
    return code ? Result<void>(Error{.file = file.string(), .what = "cannot be copied to " + copy.string() + ": " + code.message()})
                : Result<void>();
}

// Whatever could be the name of a file, as a relative path. Without recursion: the text may be nested deeply.
std::set<std::string> named_files(const Json& root) {
    std::set<std::string> names;
    std::vector<const Json*> open{&root};
    while (!open.empty()) {
        const Json& json = *open.back();
        open.pop_back();
        if (!json.is_structured()) continue;
        for (const auto& [key, value] : json.items()) {
            open.push_back(&value);
            if (!value.is_string()) continue;
            const std::string text = value.get<std::string>();
            if (key == "uri" && !is_data_uri(text)) names.insert(percent_decoded(text));
            if (key == "file") names.insert(text);
        }
    }
    return names;
}

} // namespace

Result<std::filesystem::path> gather_scene(const std::filesystem::path& file, const std::string& json, const std::filesystem::path& into) {
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    const Result<Json> parsed = parse_json_object(json);
    if (!parsed) return parsed.error();
    const std::filesystem::path copy = into / file.filename();
    if (const Result<void> copied = copy_into(file, copy); !copied) return copied.error();
    std::error_code code;
    for (const std::string& name : named_files(*parsed)) {
        const std::filesystem::path from = folder / name, to = into / name;
        const bool inside = std::filesystem::path(name).is_relative() && is_below(from, folder) && is_below(to, into);
        if (!inside || !std::filesystem::is_regular_file(from, code)) continue;
        if (const Result<void> copied = copy_into(from, to); !copied) return copied.error();
    }
    return copy;
}

Result<std::string> gather_environment(const std::string& edits, const std::filesystem::path& folder, const std::filesystem::path& into) {
    Result<Json> parsed = parse_json_object(edits);
    if (!parsed) return edits; // empty: no edits
    const Json::json_pointer where("/environment/file");
    if (!parsed->contains(where) || !parsed->at(where).is_string() || parsed->at(where).get<std::string>().empty()) return edits;
    const std::filesystem::path named = parsed->at(where).get<std::string>(), file = named.is_absolute() ? named : folder / named;
    if (is_below(file, into)) return edits;
    // Two maps may have one name.
    std::error_code code;
    std::filesystem::path name = std::filesystem::path("environments") / file.filename();
    for (int i = 2; std::filesystem::exists(into / name, code) && !std::filesystem::equivalent(into / name, file, code) && i < 1000; ++i) {
        if (std::filesystem::file_size(into / name, code) == std::filesystem::file_size(file, code)) break; // its pixels are hashed
        name.replace_filename(fmt::format("{}-{}", i, file.filename().string()));
    }
    if (const Result<void> copied = copy_into(file, into / name); !copied) return copied.error();
    (*parsed)[where] = name.string();
    return json_text(*parsed);
}

} // namespace blush
