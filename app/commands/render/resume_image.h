// Loads an image to resume rendering from: `blush render --continue`, `blush merge`.
#pragma once

#include "app/commands/load_scene.h"
#include "core/result.h"
#include "io/image/snapshot.h"
#include "render/film/film_state.h"

#include <string>

namespace blush {

struct ResumeImage {
    SnapshotMetadata metadata;
    FilmState film;
};

// Errors name the file: unreadable, not written by Blush, saved without its film.
Result<ResumeImage> read_resume_image(const std::string& file);

// The scene of the image in `file` when it was rendered: `scene_file` with the edits stored in the image. Errors: another
// scene, or not all edits are stored in the image.
Result<LoadedScene> scene_at_save(LoadedScene loaded, const std::string& scene_file, const ResumeImage& begun, const std::string& file);

} // namespace blush
