#include "render/materials/texture_mips.h"

#include "core/box_filter.h"

#include <algorithm>
#include <array>
#include <bit>

namespace blush {
namespace {

// Cells of the finer row that one cell of the half-size row covers: two, or three for odd sizes. Cells outside have weight 0.
struct Cells {
    size_t first = 0;
    std::array<float, 3> shares{};
};

std::vector<Cells> cells_of(int from, int to) {
    std::vector<Cells> cells(static_cast<size_t>(to));
    for (int i = 0; i < to; ++i) {
        Cells& c = cells[size_t(i)];
        size_t count = 0;
        for_each_box_weight(i, from, to, [&](int cell, float share) {
            if (count == 0) c.first = size_t(cell);
            c.shares[count++] = share;
        });
    }
    return cells;
}

TextureMip half_of(int width, int height, const ReadRow& read) {
    TextureMip mip{halved(width, 1), halved(height, 1), {}};
    const size_t row_size = size_t(mip.width) * 4;
    mip.rgba.resize(row_size * size_t(mip.height));
    const std::vector<Cells> columns = cells_of(width, mip.width);
    std::vector<float> row(size_t(width + 2) * 4); // two more, because cells may lie outside
    for (int y = 0; y < mip.height; ++y)
        for_each_box_weight(y, height, mip.height, [&](int from, float share) {
            read(from, row.data());
            float* sum = mip.rgba.data() + size_t(y) * row_size;
            for (const Cells& cells : columns) {
                const float* texel = row.data() + 4 * cells.first;
                for (size_t c = 0; c < 4; ++c)
                    *sum++ += share * (cells.shares[0] * texel[c] + cells.shares[1] * texel[c + 4] + cells.shares[2] * texel[c + 8]);
            }
        });
    return mip;
}

} // namespace

int mip_count(int width, int height) { return std::bit_width(unsigned(std::max(width, height))); }

void make_mips(int width, int height, const ReadRow& read, const std::function<void(const TextureMip&)>& take) {
    if (width <= 1 && height <= 1) return;
    TextureMip mip = half_of(width, height, read);
    while (true) {
        take(mip);
        if (mip.width <= 1 && mip.height <= 1) return;
        const auto read_mip = [&mip](int y, float* rgba) {
            const auto row = mip.rgba.begin() + std::ptrdiff_t(y) * mip.width * 4;
            std::copy(row, row + std::ptrdiff_t(mip.width) * 4, rgba);
        };
        mip = half_of(mip.width, mip.height, read_mip);
    }
}

} // namespace blush
