#include "io/gltf_import.h"

#include "io/gltf_cameras.h"
#include "io/gltf_lights.h"
#include "io/gltf_materials.h"
#include "io/gltf_meshes.h"
#include "io/gltf_nodes.h"
#include "io/gltf_report.h"
#include "io/gltf_source.h"
#include "io/gltf_textures.h"

#include <chrono>
#include <exception>
#include <new>

namespace blush {
namespace {

Result<Scene> convert(const GltfContext& context) {
    Scene scene;
    report_file(context);
    const auto nodes = reachable_nodes(context);
    if (!nodes) return nodes.error();
    context.progress(0.3, "textures");
    const auto textures = import_textures(context, scene);
    if (!textures) return textures.error();
    const auto materials = import_materials(context, *textures, scene);
    if (!materials) return materials.error();
    if (context.cancelled()) return context.cancel_error();
    context.progress(0.6, "meshes");
    auto meshes = import_meshes(context, *nodes, *materials, scene);
    if (!meshes) return meshes.error();
    const NodeTargets targets{*std::move(meshes), import_lights(context, scene), import_cameras(context, scene)};
    if (const auto ok = import_nodes(context, *nodes, targets, scene); !ok) return ok.error();
    if (const tinygltf::Scene* gltf_scene = default_scene(context)) {
        Result<Environment> environment = import_environment(context, *gltf_scene, "scenes");
        if (!environment) return environment.error();
        scene.environment = *std::move(environment);
    }
    if (context.cancelled()) return context.cancel_error();
    scene.view = initial_view(scene);
    context.progress(1, "done");
    return scene;
}

} // namespace

Result<ImportedScene> import_gltf(const std::filesystem::path& file, const ImportOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    try {
        if (options.on_progress) options.on_progress(0, "reading");
        const Result<GltfSource> source = load_gltf(file);
        if (!source) return source.error();
        ImportedScene imported;
        Result<Scene> scene = convert(GltfContext{*source, options, imported.report});
        if (!scene) return scene.error();
        imported.scene = *std::move(scene);
        imported.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return imported;
    } catch (const std::bad_alloc&) {
        return Error{file.string(), "not enough memory for the scene", ""};
    } catch (const std::exception& e) { return Error{file.string(), e.what(), ""}; }
}

} // namespace blush
