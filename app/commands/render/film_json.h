// Stores a film state in an image file: its planes as channels, the rest as JSON text.
#pragma once

#include "core/result.h"
#include "io/image/snapshot.h"
#include "render/film/film_state.h"

#include <string>
#include <vector>

namespace blush {

// Input of make_snapshot(): planes and metadata. The map of dropped samples and the pilot statistics of adaptive sampling are
// additional planes.
std::vector<LosslessPlane> planes_in_file(const FilmState& film);
std::string film_json(const FilmState& film);

// Restores the film of an image, whose planes it takes. Errors: saved without film, damaged text, invalid
// numbers, samples whose checksum differs.
Result<FilmState> film_in_file(LayeredImage& image, const SnapshotMetadata& metadata);

} // namespace blush
