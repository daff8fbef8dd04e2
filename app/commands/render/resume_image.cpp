#include "app/commands/render/resume_image.h"

#include "app/commands/common.h"
#include "app/commands/render/film_json.h"
#include "io/project/scene_edits_json.h"
#include "io/project/scene_hash.h"

#include <fmt/format.h>

namespace blush {

Result<ResumeImage> read_resume_image(const std::string& file) {
    Result<LayeredImage> image = read_layers(file);
    if (!image) return image.error();
    const Result<SnapshotMetadata> metadata = read_snapshot_metadata(image->metadata);
    if (!metadata) return in_file(metadata.error(), file);
    Result<FilmState> film = film_in_file(*image, *metadata);
    if (!film) return in_file(film.error(), file);
    return ResumeImage{*metadata, *std::move(film)};
}

Result<LoadedScene> scene_at_save(LoadedScene loaded, const std::string& scene_file, const ResumeImage& begun, const std::string& file) {
    const SnapshotMetadata& m = begun.metadata;
    if (scene_hash(loaded.imported) != m.scene_hash)
        return Error{file, fmt::format("was rendered from another scene than {}, or from an older version of it", scene_file), ""};
    if (count_left_out(m.edits) > 0) return Error{file, "its scene had edits that are not stored in the image", "blush:edits left_out"};
    if (m.edits.empty()) return loaded;
    Result<Scene> edited = apply_edits_json(loaded.imported, m.edits);
    if (!edited) return in_file(edited.error(), file);
    loaded.scene = *std::move(edited);
    return loaded;
}

} // namespace blush
