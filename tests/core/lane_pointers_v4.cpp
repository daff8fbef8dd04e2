#include "tests/core/lane_pointers_check.h"

namespace blush::test {

bool lane_pointers_v4(const char* words, const void* unreadable) { return reads_only_active_lanes<Wide>(words, unreadable); }

} // namespace blush::test
