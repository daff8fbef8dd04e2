// A film state as part of a picture's file: its planes are channels, the rest is text.
#pragma once

#include "core/result.h"
#include "io/snapshot.h"
#include "render/film_state.h"

#include <string>
#include <vector>

namespace blush {

// What make_snapshot() takes: planes and metadata. Health's map of dropped samples and what adaptive
// sampling remembers of its pilot are more planes.
std::vector<ExactPlane> planes_in_file(const FilmState& film);
std::string film_json(const FilmState& film);

// The film that the picture was saved with. Errors: saved without one, damaged text, numbers that no film has.
Result<FilmState> film_in_file(const LayeredImage& image, const SnapshotMetadata& metadata);

} // namespace blush
