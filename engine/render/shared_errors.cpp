#include "render/shared_errors.h"

#include "render/film.h"
#include "render/sample_plan.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr int max_pixels = 1 << 18; // that are looked at: in blocks all over the film, and not for long

Vec3d half_difference(const PixelHalves& p) {
    if (!p.known) return {0, 0, 0};
    return (p.a - p.b) * std::sqrt(p.weight_a * (1 - p.weight_a));
}

// Of blocks of so many pixels: the mean square of the sum of their half differences over the sum of the squares, 1 if pixels err alone.
double ratio_of_blocks(const Film& film, int width, int height) {
    const int across = (film.width() + width - 1) / width, blocks = across * ((film.height() + height - 1) / height);
    double together = 0, apart = 0;
    for (int block = 0; block < blocks; block += 1 + int(int64_t(blocks) * width * height / max_pixels)) {
        const int left = block % across * width, top = block / across * height;
        Vec3d sum{0, 0, 0};
        for (int y = top; y < std::min(top + height, film.height()); ++y)
            for (int x = left; x < std::min(left + width, film.width()); ++x) {
                const Vec3d d = half_difference(film.halves(size_t(y) * size_t(film.width()) + size_t(x)));
                sum = sum + d;
                apart += dot(d, d);
            }
        together += dot(sum, sum);
    }
    return apart > 0 ? together / apart : 1;
}

} // namespace

SharedErrors measure_shared_errors(const Film& film, const ReuseGroups& groups) {
    constexpr int near_side = SamplePlan::tile_size;
    const double most = groups.size();
    SharedErrors shared;
    shared.means = std::clamp(ratio_of_blocks(film, groups.block_width, groups.block_height), 1.0, most);
    const double near = std::clamp(ratio_of_blocks(film, near_side, near_side), 1.0, shared.means);
    const auto of_products = [](double ratio, double partners) { return ratio * ratio / partners; };
    shared.products = 1 + of_products(near - 1, near_side * near_side * (1 - 1 / most)) +
                      of_products(shared.means - near, groups.block_width * groups.block_height - near_side * near_side);
    return shared;
}

ErrorEstimate estimate_error(const Film& film, int reuse, const Workers& workers) {
    return film.estimate_error(workers, reuse > 1 ? measure_shared_errors(film, reuse_groups(reuse)).products : 1);
}

} // namespace blush
