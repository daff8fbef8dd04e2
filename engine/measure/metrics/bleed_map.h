// For each cell of a grid over the image: the object that sends it the most scattered light, probed in passes of one batch per cell
// (render/diagnostics/bleed_paths.h).
#pragma once

#include "render/diagnostics/bleed_tracer.h"

#include <functional>
#include <map>
#include <vector>

namespace blush {

struct BleedCell {
    uint32_t object = 0; // Id<Node>.value; 0: no scattered light
    float share = 0;     // of the cell's light that it sends, 0 .. 1
    bool operator==(const BleedCell&) const = default;
};
struct BleedGrid {
    int cell = 0, columns = 0, rows = 0; // side of a cell in pixels, cut at the right and the lower edge; number of cells
    int64_t passes = 0;                  // whole passes
    std::vector<BleedCell> cells;        // by rows
};

class BleedMap {
public:
    // 0 threads: one per core.
    explicit BleedMap(unsigned threads, bool low_priority = false) : tracer_(threads, low_priority) {}

    // Restarts with cells of `cell` x `cell` pixels. Throws as Renderer::update does.
    void begin(const Scene& scene, const RenderSettings& settings, int cell);
    // One more batch in the next cells. False if `wanted` returned false: they are then discarded.
    bool round(const std::function<bool()>& wanted = {});
    const BleedGrid& grid() const { return grid_; }

private:
    struct Sums {
        double whole = 0;
        std::map<uint32_t, double> by_object;
    };

    BleedTracer tracer_;
    BleedGrid grid_;
    std::vector<BleedTarget> targets_;
    std::vector<Sums> sums_; // luminance, by cell
    size_t next_ = 0;
};

} // namespace blush
