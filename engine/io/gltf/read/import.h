// Imports glTF 2.0 (.gltf, .glb). Only io/gltf uses tinygltf. Treats any input as hostile.
#pragma once

#include "core/result.h"
#include "io/gltf/read/geometry/indices.h"
#include "io/gltf/read/import_options.h"
#include "io/gltf/read/import_report.h"
#include "scene/render_settings.h"
#include "scene/scene.h"
#include "scene/view_settings.h"

#include <filesystem>
#include <optional>

namespace blush {

struct ImportedScene {
    Scene scene;
    ImportReport report;
    GltfOrigin origin;
    // Data that saving wrote besides the scene, if Blush saved the file.
    bool has_view = false; // scene.view is the saved one
    std::optional<RenderSettings> render = {};
    std::optional<ViewSettings> view = {};
};

// Imports the file's default scene, the saved view or that of the first camera (or one framed around the geometry), lights of
// KHR_lights_punctual, EXT_lights_area and EXT_lights_ies, and `extras.blush`: on the scene `environment` {kind, color,
// intensity, rotation_degrees, file, visible_to_camera} (its file relative to the scene's folder), on a light `angle_degrees`,
// `radius`, `rectangle` {width, height, two_sided}, on a camera `aperture_radius`, `focus_distance`, and on any object the fields
// that glTF cannot express (io/gltf/write/save.h). Ids are deterministic: two imports of a file give the same ids, and saving and
// loading a scene keeps them.
// Errors: unreadable, not glTF, a required extension that is not supported, an index out of range, a buffer that is missing or too
// short, a file URI that leaves the scene's folder or is not a plain relative path.
Result<ImportedScene> import_gltf(const std::filesystem::path& file, const ImportOptions& options = {});

} // namespace blush
