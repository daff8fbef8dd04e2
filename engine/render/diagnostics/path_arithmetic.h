// The arithmetic of a path as text, one product for each contribution: "0.7 x 0.9 x 12 = 7.56".
#pragma once

#include "render/diagnostics/path_record.h"

#include <string>
#include <vector>

namespace blush {

enum class RgbChannel : uint8_t { red, green, blue };
std::string_view to_string(RgbChannel channel);
float channel_of(const Vec3& color, RgbChannel channel);
// The channel in which the path gives most light; without light, in which its throughput is largest.
RgbChannel main_channel(const RecordedPath& path);

// One contribution of the path in one channel.
struct PathTerm {
    size_t vertex = 0; // where the path receives it
    FoundBy by = FoundBy::camera_hit;
    // The factors in the order of the path: for each vertex before, f |cos| / pdf, "/ q" if it survived Russian roulette and the
    // transmittance of panes and solids; then of next event estimation f |cos| / p; then L_e. Behind ";" the MIS weight, unless it is 1,
    // and whether something blocks the light. Four digits, so that a product of rounded factors may differ in the last.
    std::string text;
    float value = 0; // nits: what the film receives
};
// In the order of the path. Without the contributions that are 0, except blocked light.
std::vector<PathTerm> terms_of(const RecordedPath& path, RgbChannel channel);

// What a vertex did to the throughput, for the rows of the path tool: "x 0.7", "x 0.9 / 0.5", "mirrors x 0.95", "ends: roulette, q 0.31".
std::string step_text(const PathVertex& vertex, RgbChannel channel);

// Several lines for the terminal: a header, the terms, and the sum if there are several.
std::string path_text(const RecordedPath& path, RgbChannel channel);

} // namespace blush
