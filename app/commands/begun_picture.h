// A picture in a file that rendering goes on from: `blush render --continue`, `blush merge`.
#pragma once

#include "app/commands/load_scene.h"
#include "core/result.h"
#include "io/snapshot.h"
#include "render/film_state.h"

#include <string>

namespace blush {

struct BegunPicture {
    SnapshotMetadata metadata;
    FilmState film;
};

// Errors name the file: unreadable, not one of our pictures, saved without its film.
Result<BegunPicture> read_begun_picture(const std::string& file);

// The scene that the picture in `file` was begun with: what `scene_file` holds, edited as the picture says. Errors: it is another one, or not
// all that was changed is in the picture.
Result<LoadedScene> as_begun(LoadedScene loaded, const std::string& scene_file, const BegunPicture& begun, const std::string& file);

} // namespace blush
