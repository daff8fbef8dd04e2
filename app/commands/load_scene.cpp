#include "app/commands/load_scene.h"

#include "app/commands/common.h"
#include "app/commands/progress.h"
#include "io/gltf/read/camera_aspects.h"

namespace blush {

Result<LoadedScene> load_scene(const std::filesystem::path& file, const SceneOverrides& overrides, float aspect, Progress& progress,
                               const std::atomic<bool>& interrupted) {
    ImportOptions options;
    options.cancel = &interrupted;
    options.on_progress = [&](double fraction, const std::string& what) { progress.update(fraction, what); };
    if (overrides.texture_mib) options.texture_bytes = *overrides.texture_mib << 20;
    Result<ImportedScene> imported = import_gltf(file, options);
    if (!imported) return in_file(imported.error(), file.string());
    LoadedScene loaded{imported->scene, std::move(imported->scene), std::move(imported->report)};
    if (Result<void> applied = apply_overrides(overrides, loaded.scene, aspect, imported->has_view, &loaded.report.diagnostics); !applied)
        return in_file(applied.error(), file.string());
    const float own = aspect_of_camera(camera_aspects(imported->origin), loaded.scene);
    loaded.camera_aspect = imported->view && imported->view->frame_aspect ? *imported->view->frame_aspect : own;
    return loaded;
}

} // namespace blush
