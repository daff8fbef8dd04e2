#include "app/commands/load_scene.h"

#include "app/commands/common.h"
#include "app/commands/progress.h"
#include "io/gltf/read/camera_aspects.h"

namespace blush {

Result<ImportedScene> import_scene(const std::filesystem::path& file, std::optional<int64_t> texture_mib, Progress& progress,
                                   const std::atomic<bool>& interrupted) {
    ImportOptions options;
    options.cancel = &interrupted;
    options.on_progress = [&](double fraction, const std::string& what) { progress.update(fraction, what); };
    if (texture_mib) options.texture_bytes = *texture_mib << 20;
    Result<ImportedScene> imported = import_gltf(file, options);
    if (!imported) return in_file(imported.error(), file.string());
    return imported;
}

Result<LoadedScene> overridden(ImportedScene imported, const std::filesystem::path& file, const SceneOverrides& overrides, float aspect) {
    LoadedScene loaded{imported.scene, std::move(imported.scene), std::move(imported.report)};
    if (Result<void> applied = apply_overrides(overrides, loaded.scene, aspect, imported.has_view, &loaded.report.diagnostics); !applied)
        return in_file(applied.error(), file.string());
    const float own = aspect_of_camera(camera_aspects(imported.origin), loaded.scene);
    loaded.camera_aspect = imported.view && imported.view->frame_aspect ? *imported.view->frame_aspect : own;
    return loaded;
}

Result<LoadedScene> load_scene(const std::filesystem::path& file, const SceneOverrides& overrides, float aspect, Progress& progress,
                               const std::atomic<bool>& interrupted) {
    Result<ImportedScene> imported = import_scene(file, overrides.texture_mib, progress, interrupted);
    if (!imported) return imported.error();
    return overridden(*std::move(imported), file, overrides, aspect);
}

} // namespace blush
