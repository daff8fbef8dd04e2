// glTF 2.0 (.gltf, .glb) to a Scene: the only file (gltf_*.cpp) that knows tinygltf. Any input may be hostile.
#pragma once

#include "core/result.h"
#include "io/gltf_indices.h"
#include "scene/render_settings.h"
#include "scene/scene.h"
#include "scene/view_settings.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace blush {

struct ImportReport {
    std::vector<std::string> extensions_used, extensions_honoured, extensions_approximated, extensions_ignored;
    // Everything the file says that the picture will not show, and everything suspicious.
    std::vector<Diagnostic> diagnostics;
    double seconds = 0;
};

struct ImportedScene {
    Scene scene;
    ImportReport report;
    GltfOrigin origin;
    // What saving wrote beside the scene, if a program of ours has saved it.
    bool has_view = false; // scene.view is the one that was saved
    std::optional<RenderSettings> render = {};
    std::optional<ViewSettings> view = {};
};

struct ImportOptions {
    unsigned threads = 0; // that convert meshes and decode textures, this one included; 0: one per core; whatever it is, the result is the same

    std::function<void(double fraction, const std::string& what)> on_progress; // called on the importing thread
    const std::atomic<bool>* cancel = nullptr;                                 // true ends the import with the error "cancelled"
    int64_t texture_bytes = int64_t(4) << 30; // of all textures of the file as decoded; the largest are halved until they fit
    // Called once, on the importing thread, if textures take longer than all else: with everything but those, as untextured.h shows it.
    // They may still turn out to be unreadable, and the import may still be cancelled.
    std::function<void(const ImportedScene&)> on_untextured = {};
};

// The file's default scene, the view that was saved with it or its first camera as the view (or one framed around the geometry), lights of
// KHR_lights_punctual, EXT_lights_area and EXT_lights_ies, and what `extras.blush` adds: on the scene `environment` {kind, color, intensity,
// rotation_degrees, file, visible_to_camera} (its file relative to the scene's folder), on a light `angle_degrees`, `radius`, `rectangle`
// {width, height, two_sided}, on a camera `aperture_radius`, `focus_distance`, and on anything what saving could not say otherwise
// (gltf_save.h). Two imports of one file give the same ids, and so do a scene and what is read of it after saving.
// Errors: unreadable, not glTF, a required extension that is not supported, an index out of range, a buffer that is missing or too
// short, a file URI that leaves the scene's folder or is not a plain relative path.
Result<ImportedScene> import_gltf(const std::filesystem::path& file, const ImportOptions& options = {});

} // namespace blush
