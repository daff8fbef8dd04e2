#include "render/shared_errors.h"

#include "render/film.h"
#include "render/path_reuse.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace blush {
namespace {

constexpr int most_blocks = 512; // of groups, that are looked at: all over the film, and not for long

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
    const auto add_pair = [&](const Members& one, const Members& other) {
        Vec3d sum{0, 0, 0}, other_sum{0, 0, 0};
        double product = 0;
        for (size_t m = 0; m < size_t(groups.size()); ++m) {
            const double p = dot(one[m], other[m]);
            sum = sum + one[m];
            other_sum = other_sum + other[m];
            product += p;
            means.apart += dot(one[m], one[m]) + dot(other[m], other[m]);
            products.apart += p * p;
        }
        means.together += dot(sum, sum) + dot(other_sum, other_sum);
        products.together += product * product;
    };
    const int width = groups.columns * cell, height = groups.rows * cell;
    const int across = (job.width + width - 1) / width, blocks = across * ((job.height + height - 1) / height);
    for (int block = 0; block < blocks; block += 1 + blocks / most_blocks)
        for (int in_cell = 0; in_cell < cell * cell; in_cell += 2) {
            const int x = block % across * width, y = block / across * height;
            add_pair(members_of(x, y, in_cell), members_of(x, y, in_cell + 1));
        }
    return {means.ratio(groups), products.ratio(groups)};
}

ErrorEstimate estimate_error(const Film& film, int reuse, const Workers& workers) {
    return film.estimate_error(workers, reuse > 1 ? measure_shared_errors(film, reuse_groups(reuse)).products : 1);
}

} // namespace blush
