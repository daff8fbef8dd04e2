#include "tests/bench/net.h"

#include <cmath>

namespace blush::bench {

Geometry net(uint32_t n) {
    Geometry g;
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) {
            const float x = 2 * float(i) / float(n) - 1, z = 2 * float(j) / float(n) - 1, slope = 0.9f * std::cos(9 * x),
                        size = std::hypot(slope, 1.f);
            g.positions.push_back({x, 0.1f * std::sin(9 * x), z});
            g.normals.push_back({-slope / size, 1 / size, 0});
        }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            g.indices.insert(g.indices.end(), {a, d, b, a, c, d});
        }
    return g;
}

} // namespace blush::bench
