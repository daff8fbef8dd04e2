#include "render/shared_errors.h"

#include "render/film.h"
#include "render/path_reuse.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace blush {
namespace {

// Half differences of the members, 0 for those beyond the film.
using Members = std::array<Vec3d, ReuseGroups::largest>;

Vec3d half_difference(const PixelHalves& p) {
    if (!p.known) return {0, 0, 0};
    return (p.a - p.b) * std::sqrt(p.weight_a * (1 - p.weight_a));
}

struct Sums {
    double together = 0, apart = 0;
    double ratio(const ReuseGroups& groups) const { return apart > 0 ? std::clamp(together / apart, 1.0, double(groups.size())) : 1; }
};

} // namespace

SharedErrors measure_shared_errors(const Film& film, const ReuseGroups& groups) {
    constexpr int cell = ReuseGroups::cell;
    TileJob job; // the whole film, one sample: slots are pixels
    job.width = film.width();
    job.height = film.height();
    const auto members_of = [&](int block_x, int block_y, int in_cell) {
        Members members{};
        for (int m = 0; m < groups.size(); ++m) {
            const int pixel =
                slot_of_member(job, block_x, block_y, m % groups.columns, m / groups.columns, in_cell % cell, in_cell / cell, 0);
            if (pixel >= 0) members[size_t(m)] = half_difference(film.halves(size_t(pixel)));
        }
        return members;
    };
    Sums means, products;
    for (int block_y = 0; block_y < job.height; block_y += groups.rows * cell)
        for (int block_x = 0; block_x < job.width; block_x += groups.columns * cell)
            for (int in_cell = 0; in_cell < cell * cell; ++in_cell) {
                const Members own = members_of(block_x, block_y, in_cell), beside = members_of(block_x, block_y, in_cell ^ 1);
                Vec3d sum{0, 0, 0};
                double product = 0;
                for (size_t m = 0; m < size_t(groups.size()); ++m) {
                    const double p = dot(own[m], beside[m]);
                    sum = sum + own[m];
                    product += p;
                    means.apart += dot(own[m], own[m]);
                    products.apart += p * p;
                }
                means.together += dot(sum, sum);
                products.together += product * product;
            }
    return {means.ratio(groups), products.ratio(groups)};
}

} // namespace blush
