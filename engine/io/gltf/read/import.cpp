#include "io/gltf/read/import.h"

#include "io/gltf/check/lint.h"
#include "io/gltf/check/report.h"
#include "io/gltf/check/size_limits.h"
#include "io/gltf/compression/decompress.h"
#include "io/gltf/read/animations.h"
#include "io/gltf/read/cameras.h"
#include "io/gltf/read/context.h"
#include "io/gltf/read/convert.h"
#include "io/gltf/read/extras.h"
#include "io/gltf/read/geometry/deform.h"
#include "io/gltf/read/geometry/meshes.h"
#include "io/gltf/read/geometry/skins.h"
#include "io/gltf/read/images/textures.h"
#include "io/gltf/read/lights/image_based_light.h"
#include "io/gltf/read/lights/lights.h"
#include "io/gltf/read/materials.h"
#include "io/gltf/read/nodes.h"
#include "io/gltf/read/scene_selection.h"
#include "io/gltf/read/source.h"
#include "io/gltf/read/variants.h"
#include "io/project/settings_json.h"
#include "scene/document/preview_scene.h"

#include <chrono>
#include <exception>
#include <new>
#include <utility>

namespace blush {
namespace {

// Maps each id that is not none to its index.
template <class T> std::map<Id<T>, int> indices_of(const std::vector<Id<T>>& ids) {
    std::map<Id<T>, int> indices;
    for (size_t i = 0; i < ids.size(); ++i)
        if (ids[i]) indices[ids[i]] = int(i);
    return indices;
}

// Reads the data that saving wrote besides the scene. Invalid settings are ignored.
template <class Settings>
std::optional<Settings> saved_settings(const GltfContext& context, const nlohmann::json& gltf_scene, const char* key,
                                       Result<ParsedSettings<Settings>> (*parse)(std::string_view, const Settings&)) {
    const std::string where = fmt::format("scene.extras.blush.{}", key);
    const Json json = blush_fields(context, gltf_scene, key, where);
    if (json.is_null()) return std::nullopt;
    const auto parsed = parse(json_text(json), {});
    if (parsed) return parsed->settings;
    context.warn("ignored: " + parsed.error().text(), where);
    return std::nullopt;
}

void import_mix(const GltfContext& context, const nlohmann::json& gltf_scene, const std::string& where, LightMix& mix) {
    LightMix candidate;
    read_extra_fields(context, blush_fields(context, gltf_scene, "mix", where), candidate, where);
    if (const auto valid = validate(candidate); valid)
        mix = std::move(candidate);
    else
        context.warn("ignored: " + valid.error().what, where);
}

Result<void> import_scene_extras(const GltfContext& context, size_t index, ImportedScene& imported) {
    const nlohmann::json& object = gltf_item(context.json(), "scenes", index);
    const std::string where = fmt::format("scenes[{}]", index);
    const Environment image_light = import_image_light(context, object, where);
    imported.origin.indices.image_light = image_light.image;
    Result<Environment> environment = import_environment(context, object, where, image_light);
    if (!environment) return environment.error();
    imported.scene.environment = *std::move(environment);
    import_mix(context, object, where + ".extras.blush.mix", imported.scene.mix);
    imported.has_view = import_view(context, object, where, imported.scene.view);
    imported.render = saved_settings<RenderSettings>(context, object, "render", parse_render_settings);
    imported.view = saved_settings<ViewSettings>(context, object, "display", parse_view_settings);
    return {};
}

// Converts everything that does not need pixels.
Result<void> convert(const GltfContext& context, const std::vector<int>& nodes, const TextureImport& textures, ImportedScene& imported) {
    Scene& scene = imported.scene;
    GltfIndices& indices = imported.origin.indices;
    const std::vector<Id<Texture>> texture_ids = textures.add_to(scene);
    const auto materials = import_materials(context, texture_ids, scene);
    if (!materials) return materials.error();
    scene.variants = import_variants(context);
    const auto meshes = import_meshes(context, nodes, *materials, scene);
    if (!meshes) return meshes.error();
    const Result<LightIds> lights = import_lights(context, nodes, scene);
    if (!lights) return lights.error();
    const NodeTargets targets{meshes->ids, *lights, import_cameras(context, scene), assign_skin_ids(context)};
    const auto node_ids = import_nodes(context, nodes, targets, scene);
    if (!node_ids) return node_ids.error();

    for (size_t i = 0; i < node_ids->size(); ++i) indices.nodes[(*node_ids)[i]] = nodes[i];
    indices.textures = indices_of(texture_ids);
    indices.materials = indices_of(*materials);
    indices.meshes = indices_of(meshes->ids);
    indices.cameras = indices_of(targets.cameras);
    for (const auto& [id, index] : indices.meshes) indices.primitives[id] = meshes->primitives[size_t(index)];
    index_lights(targets.lights, indices);
    indices.skins = indices_of(targets.skins);
    if (const auto ok = import_skins(context, indices, scene); !ok) return ok;
    indices.clips = indices_of(import_animations(context, indices, scene));
    limit_deformation(context, scene);

    if (!context.known) report_units(context, scene, indices);
    const auto shown = default_scene(context);
    import_scene_names(context, scene);
    if (shown) import_scene_selection(context, *shown, indices, scene);
    scene.view = initial_view(scene);
    if (shown)
        if (const auto ok = import_scene_extras(context, *shown, imported); !ok) return ok;
    if (context.cancelled()) return context.cancel_error();
    return {};
}

// The scene with those textures that are there.
ImportedScene preview_of(const ImportedScene& converted, const TextureImport& textures) {
    ImportedScene shown = converted;
    for (const auto& [id, index] : converted.origin.indices.textures) {
        Texture texture = *shown.scene.textures.find(id);
        texture.image = textures.available(index);
        shown.scene.textures.set(id, texture);
    }
    shown.scene = preview_scene(shown.scene);
    return shown;
}

// Completes a scene that was converted without pixels.
Result<void> take_pixels(const GltfContext& context, const TextureImport& textures, ImportedScene& imported) {
    Scene& scene = imported.scene;
    scene.textures = {};
    const std::vector<Id<Texture>> texture_ids = textures.add_to(scene);
    if (!context.known) report_textures(context, scene, imported.origin.indices);
    if (!depend_on_pixels(context)) return {};
    ImportReport said_already;
    scene.materials = {};
    const auto materials = import_materials(context.reporting_to(said_already), texture_ids, scene);
    return materials ? Result<void>() : materials.error();
}

} // namespace

Result<void> convert_gltf(const GltfContext& context, ImportedScene& imported) {
    report_file(context);
    const auto nodes = reachable_nodes(context);
    if (!nodes) return nodes.error();
    if (const auto ok = check_size_limits(context, *nodes); !ok) return ok.error();
    context.progress(0.3, "meshes");
    Result<TextureImport> textures = TextureImport::begin(context);
    if (!textures) return textures.error();

    ImportedScene scene;
    Result<void> converted = convert(context.reporting_to(scene.report), *nodes, *textures, scene);
    std::function<void()> show;
    if (converted && context.options.on_preview_scene && !textures->is_done()) {
        show = [&] { context.options.on_preview_scene(preview_of(scene, *textures)); };
        show();
    }
    if (const auto ok = textures->finish(context, show); !ok) return ok;
    if (!textures->all_decoded_textures()) {    // meshes were converted for textures that cannot be decoded
        ImportOptions silent = context.options; // progress was reported already
        silent.on_progress = {};
        scene = {};
        converted = convert({context.source, silent, scene.report, context.known}, *nodes, *textures, scene);
    }
    if (!converted) return converted;
    context.add_all(scene.report.diagnostics);
    if (const auto ok = take_pixels(context, *textures, scene); !ok) return ok;
    std::swap(scene.report, imported.report);
    imported = std::move(scene);
    context.progress(1, "done");
    return {};
}

Result<ImportedScene> import_gltf(const std::filesystem::path& file, const ImportOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    try {
        if (options.on_progress) options.on_progress(0, "reading");
        Result<GltfSource> source = load_gltf(file);
        if (!source) return source.error();
        ImportedScene imported;
        if (const auto ok = decompress(*source, options, imported.report); !ok) return ok.error();
        if (const auto ok = convert_gltf(GltfContext{*source, options, imported.report}, imported); !ok) return ok.error();
        imported.origin.file = file;
        imported.origin.json = source->text;
        imported.origin.meshes = imported.scene.meshes;
        imported.origin.textures = imported.scene.textures;
        imported.origin.nodes = imported.scene.nodes;
        imported.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return imported;
    } catch (const std::bad_alloc&) {
        return Error{file.string(), "not enough memory for the scene", ""};
    } catch (const std::exception& e) { return Error{file.string(), e.what(), ""}; }
}

} // namespace blush
