#include "io/gltf/write/save.h"

#include "core/files.h"
#include "io/gltf/read/json.h"
#include "io/gltf/write/edit.h"
#include "io/gltf/write/save_files.h"

#include <exception>
#include <fmt/format.h>
#include <limits>

namespace blush {
namespace {

// True if the file to be replaced was changed by another program since it was opened.
bool has_changed_on_disk(const GltfOrigin& origin, const std::filesystem::path& file) {
    std::error_code missing;
    if (!std::filesystem::equivalent(origin.file, file, missing)) return false;
    const auto bytes = read_file(file, std::numeric_limits<uint32_t>::max());
    if (!bytes) return true;
    const auto text = gltf_json_text(*bytes);
    return !text || !text->starts_with(*origin.json) || text->find_first_not_of(' ', origin.json->size()) != text->npos;
}

// IES profiles are saved as files; without one the light has no profile after loading.
void add_profiles(SaveTransaction& files, Table<Light>& lights, std::vector<Diagnostic>& lost) {
    const Table<Light> before = lights;
    for (auto [id, light] : before) {
        if (!light.ies || light.ies_file.empty()) continue;
        if (const auto added = files.add_file(light.ies_file); !added)
            lost.push_back({Diagnostic::Severity::warning,
                            fmt::format("the IES profile of light \"{}\" is not saved: {}", light.name, added.error().text()), ""});
        lights.set(id, std::move(light));
    }
}

Result<SavedGltf> save(const GltfOrigin& origin, const Project& project, const std::filesystem::path& file, bool store_display) {
    if (has_changed_on_disk(origin, file))
        return Error{file.string(), "has changed on disk since it was opened: reload it, or save under another name", ""};
    // Referenced files are written first, since the document holds their names.
    SaveTransaction files(origin.file, file);
    Project named = project;
    std::vector<Diagnostic> lost;
    // The document contains the pixels of an image-based light.
    if (named.scene.environment.image != origin.indices.image_light)
        if (const auto ok = files.add_environment(named.scene.environment); !ok) return ok.error();
    add_profiles(files, named.scene.lights, lost);
    Result<EditedGltf> edited = edited_gltf(origin, named, store_display);
    if (!edited) return edited.error();
    edited->diagnostics.insert(edited->diagnostics.end(), lost.begin(), lost.end());
    const Result<std::string> text = files.write(edited->document, *origin.json);
    if (!text) return text.error();
    GltfOrigin written{file,
                       std::make_shared<const std::string>(*text),
                       edited->document.indices,
                       edited->scene.meshes,
                       edited->scene.textures,
                       edited->scene.nodes};
    return SavedGltf{std::move(written), std::move(edited->scene), std::move(edited->diagnostics)};
}

} // namespace

Result<SavedGltf> save_gltf(const GltfOrigin& origin, const Project& project, const std::filesystem::path& file, bool store_display) {
    try {
        return save(origin, project, file, store_display);
    } catch (const std::bad_alloc&) { return Error{file.string(), "cannot save: not enough memory", ""}; } catch (const std::exception& e) {
        return Error{file.string(), std::string("cannot save: ") + e.what(), ""};
    }
}

} // namespace blush
