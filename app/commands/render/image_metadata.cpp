#include "app/commands/render/image_metadata.h"

#include "app/commands/render/write_image.h"
#include "io/project/scene_edits_json.h"

namespace blush {

SnapshotMetadata image_metadata(const std::filesystem::path& scene_file, const std::string& hash, const LoadedScene& loaded,
                                const RenderSettings& settings, const LoopResult& result) {
    SnapshotMetadata m;
    m.version = BLUSH_VERSION;
    m.scene = scene_file.filename().string();
    m.scene_hash = hash;
    m.camera = camera_name(loaded.scene);
    m.spp = result.samples;
    m.first_sample = settings.first_sample;
    m.last_sample = settings.first_sample + result.samples;
    m.seed = settings.seed;
    m.seconds = result.seconds;
    m.error = error_text(result.frame.error);
    m.settings = settings;
    m.edits = edits_json(loaded.imported, loaded.scene);
    m.partial = !result.complete;
    return m;
}

} // namespace blush
