#include "measure/stability/findings.h"

#include <cmath>
#include <fmt/format.h>

namespace blush::stability {

Finding compare(const Measured& seen, double expected, double rounding) { return {expected, seen.mean.x, seen.error.x, rounding, {}}; }

Findings whole(const RenderedImage& image, double expected, double rounding) { return {compare(image.whole(), expected, rounding)}; }

Findings every_pixel(const RenderedImage& image, double expected, double rounding) {
    Findings all;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) all.push_back({expected, image.at(x, y).x, 0, rounding, fmt::format("pixel {},{}", x, y)});
    return all;
}

Findings quarters(const Scene& scene, const FloorIrradiance& irradiance, const RenderSettings& settings) {
    Findings all;
    for (const FloorQuarter& q : photograph_floor(scene, irradiance, settings)) {
        all.push_back(compare(q.seen, q.expected));
        all.back().where = fmt::format("quarter {}", all.size());
    }
    return all;
}

Findings same_blocks(const RenderedImage& a, const RenderedImage& b, int block) {
    const std::vector<Measured> first = a.blocks(block, block), second = b.blocks(block, block);
    Findings all;
    for (size_t i = 0; i < first.size(); ++i) {
        const double error = std::hypot(first[i].error.x, second[i].error.x);
        all.push_back({first[i].mean.x, second[i].mean.x, error, 0, fmt::format("block {}", i)});
    }
    return all;
}

Finding count_of(double wrong, std::string where) { return {0, wrong, 0, 0, std::move(where)}; }

} // namespace blush::stability
