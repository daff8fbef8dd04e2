// MIS weights of bidirectional path tracing (Veach 1997, section 10.2): the densities with which each strategy samples one path.
//
// A path is x_0 on the light, x_1 ... x_{k-1} on surfaces, x_k at the camera. Strategy s samples s vertices from the light and the others
// from the camera, and connects x_{s-1} with x_s:
//
//     s = 0      the camera path hits the light
//     s = 1      NEE from x_1
//     2 <= s < k a vertex of the light path is connected with one of the camera path
//     s = k      a vertex of the light path is connected with the camera ("light tracing")
//
// Densities are over projected solid angle; edge i, from x_i to x_{i+1}, has the geometry term G_i. Those of neighbouring strategies are
//
//     p_1 / p_0 = nee / toward_light[0],   p_2 / p_1 = emission / (nee toward_light[1] G_1),
//     p_{s+1} / p_s = toward_camera[s-1] G_{s-1} / (toward_light[s] G_s)
//
// where the last step, to s = k, has a factor `light_paths`, since all light paths of a pass may reach the pixel. Delta lobes have density
// 1 in both directions, and no strategy connects there. Weights add up to 1 for any densities that all strategies agree on, so Russian
// roulette is left out.
#pragma once

#include <array>

namespace blush {

struct PathDensities {
    static constexpr int max_light_vertices = 16; // surfaces on a light path; longer ones are found from the camera
    static constexpr int size = max_light_vertices + 2;

    int edges = 0;                            // k
    std::array<double, size> toward_camera{}; // [i], i >= 1: at x_i, of the direction to x_{i+1}
    std::array<double, size> toward_light{};  // [i]: at x_{i+1}, of the direction to x_i; [k-1]: pixels per area at x_{k-1}
    std::array<double, size> geometry{};      // [i], i >= 1: G_i; [k-1]: 1
    std::array<bool, size> delta{};           // [i], i >= 1: the path leaves x_i by a delta lobe
    double nee = 0;                           // of x_0 by NEE at x_1
    double emission = 0;                      // of x_0 and the direction to x_1 by the emission of light paths
    bool light_can_be_hit = false;            // the light has a size
    double light_paths = 1;                   // for one camera path of every pixel

    // True if strategy s can sample the path.
    bool possible(int s) const;
    // MIS weight of strategy s by the power heuristic (exponent 2), which must be possible.
    double weight(int s) const;
};

} // namespace blush
