#include "io/image/ies.h"

#include "scene/lights/ies_profile.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

#include <cmath>

namespace blush::fuzz {
namespace {

Result<void> is_finite(const std::vector<float>& values) {
    for (const float v : values)
        if (!std::isfinite(v)) return Error{"", "a number of a profile is not finite", ""};
    return {};
}

} // namespace

void ies(std::span<const uint8_t> bytes) {
    const auto profile = parse_ies({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (!profile) return;
    promise(is_finite((*profile)->vertical));
    promise(is_finite((*profile)->horizontal));
    promise(is_finite((*profile)->candela));
}

} // namespace blush::fuzz
