// Memory that an undo step keeps alive.
#pragma once

#include "scene/document/edit.h"

#include <cstddef>

namespace blush {

// Estimated bytes that `kept` holds and `neighbour` does not share: whole tables (copied when one record changes), and pixels
// without another owner.
size_t bytes_held(const Project& kept, const Project& neighbour);

} // namespace blush
