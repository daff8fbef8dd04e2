#include "render/surroundings.h"

#include <algorithm>

namespace blush {
namespace {

// Sums over three pixels side by side, of row y.
void sum_across(std::span<const float> rgba, int width, int y, std::vector<Vec3>& sums) {
    const float* row = &rgba[4 * size_t(y) * size_t(width)];
    const auto sum = [&](int first, int last) {
        Vec3 s{0, 0, 0};
        for (int i = first; i <= last; ++i) s = {s.x + row[4 * i], s.y + row[4 * i + 1], s.z + row[4 * i + 2]};
        return s;
    };
    for (int x = 0; x < width; ++x) sums[size_t(x)] = sum(std::max(0, x - 1), std::min(width - 1, x + 1));
}

int clipped_count(int at, int size) { return std::min(at + 1, size - 1) - std::max(at - 1, 0) + 1; }

} // namespace

Surroundings::Surroundings(std::span<const float> rgba, int width, int height, int first_row, int last_row)
    : rgba_(rgba), width_(width), height_(height), first_(std::max(0, first_row - 1)) {
    const int last = std::min(height, last_row + 1);
    blocks_.assign(size_t(last - first_) * size_t(width), {0, 0, 0});
    std::vector<Vec3> across(static_cast<size_t>(width));
    for (int y = std::max(0, first_ - 1), end = std::min(height, last + 1); y < end; ++y) {
        sum_across(rgba, width, y, across);
        for (int to = std::max(first_, y - 1); to <= std::min(last - 1, y + 1); ++to) {
            Vec3* blocks = &blocks_[size_t(to - first_) * size_t(width)];
            for (int x = 0; x < width; ++x) {
                blocks[x].x += across[size_t(x)].x;
                blocks[x].y += across[size_t(x)].y;
                blocks[x].z += across[size_t(x)].z;
            }
        }
    }
}

int Surroundings::pixels_in_block(int x, int y) const { return clipped_count(x, width_) * clipped_count(y, height_); }

Surroundings::Around Surroundings::around(int x, int y) const {
    const float* rgba = &rgba_[4 * (size_t(y) * size_t(width_) + size_t(x))];
    const Vec3 own{rgba[0], rgba[1], rgba[2]};
    const bool inside = x > 1 && y > 1 && x < width_ - 2 && y < height_ - 2;
    Vec3 sum{0, 0, 0}, darkest{0, 0, 0};
    int blocks = 0;
    for (const int dy : {-1, 1})
        for (const int dx : {-1, 1}) {
            if (!inside && (x + dx < 0 || x + dx >= width_ || y + dy < 0 || y + dy >= height_)) continue;
            const Vec3& block = blocks_[size_t(y + dy - first_) * size_t(width_) + size_t(x + dx)];
            const float inverse = inside ? 1.f / 8 : 1.f / float(pixels_in_block(x + dx, y + dy) - 1);
            // Sums of floats: what is left of dark pixels beside a bright one may be rounding.
            const Vec3 mean{std::max(0.f, (block.x - own.x) * inverse), std::max(0.f, (block.y - own.y) * inverse),
                            std::max(0.f, (block.z - own.z) * inverse)};
            sum = {sum.x + mean.x, sum.y + mean.y, sum.z + mean.z};
            darkest = blocks == 0 ? mean : Vec3{std::min(darkest.x, mean.x), std::min(darkest.y, mean.y), std::min(darkest.z, mean.z)};
            ++blocks;
        }
    if (blocks == 0) sum = darkest = own, blocks = 1;
    const double inverse = 1.0 / blocks;
    return {{double(sum.x) * inverse, double(sum.y) * inverse, double(sum.z) * inverse},
            {double(darkest.x), double(darkest.y), double(darkest.z)}};
}

} // namespace blush
