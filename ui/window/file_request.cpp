#include "ui/window/file_request.h"

namespace blush {

const char* title_of(FileRequest::Use use) {
    using Use = FileRequest::Use;
    switch (use) {
    case Use::open: return "Open a scene or an image";
    case Use::import_scene: return "Import into the scene";
    case Use::environment: return "Choose an environment image";
    case Use::ies: return "Choose a photometric file";
    case Use::snapshot_folder: return "Choose the folder for snapshots";
    case Use::convergence: return "Load a convergence table";
    case Use::map: return "Choose an image for the material";
    case Use::save_scene: return "Save the scene as";
    case Use::looks: return "Choose the looks for the farm";
    }
    return "";
}

const ExtensionFilter& filter_of(FileRequest::Use use) {
    using Use = FileRequest::Use;
    static const ExtensionFilter none, openable{".gltf", ".glb", ".exr"}, looks{".json"};
    switch (use) {
    case Use::open: return openable;
    case Use::import_scene:
    case Use::save_scene: return scene_files;
    case Use::environment: return environment_files;
    case Use::ies: return photometric_files;
    case Use::convergence: return table_files;
    case Use::map: return image_files;
    case Use::looks: return looks;
    case Use::snapshot_folder: break;
    }
    return none;
}

} // namespace blush
