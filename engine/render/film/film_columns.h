// The columns in which kernels record what a film needs.
#pragma once

#include "render/film/film.h"

namespace blush {

// Allocates the columns of a worker's memory that the film needs, and frees the others.
void fit_columns(TileScratch& scratch, const Film& film);

} // namespace blush
