#include "ui/snapshots/heat_map.h"

#include "core/math.h"
#include "core/srgb.h"

#include <algorithm>
#include <imgui.h>
#include <iterator>

namespace blush {

Vec3 heat_map_color(float t) {
    constexpr Vec3 stops[] = {{0, 0, 0}, {0.02f, 0.03f, 0.35f}, {0.6f, 0.05f, 0.08f}, {0.95f, 0.6f, 0.05f}, {1, 1, 1}};
    constexpr int last = int(std::size(stops)) - 1;
    const float at = clamp01(t) * last;
    const int i = std::min(int(at), last - 1);
    return lerp<float>(stops[i], stops[i + 1], at - float(i));
}

uint32_t map_texel(const Vec3& linear) {
    const auto encoded = [](float v) { return int(255 * srgb_from_linear(clamp01(v)) + 0.5f); };
    return uint32_t(IM_COL32(encoded(linear.x), encoded(linear.y), encoded(linear.z), 255));
}

} // namespace blush
