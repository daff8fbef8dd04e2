#include "render/materials/texture_mips.h"

#include "core/box_filter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

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

// A row of texels, with two more, because cells may lie outside.
std::vector<float> texel_row(int width) { return std::vector<float>(size_t(width + 2) * 4); }

// Makes one level from the rows of the one above.
class HalfSize {
public:
    HalfSize(int from_width, int from_height)
        : width_(halved(from_width, 1)), is_even_(from_width == 2 * width_), across_(texel_row(width_)), sums_(texel_row(width_)) {
        if (!is_even_) columns_ = cells_of(from_width, width_);
        const int height = halved(from_height, 1);
        for (int y = 0; y < height; ++y) {
            const size_t first = terms_.size();
            for_each_box_weight(y, from_height, height, [&](int row, float share) { terms_.push_back({y, row, share}); });
            terms_[first].begins = terms_.back().ends = true;
        }
    }

    // Adds the next row; calls finished(y, rgba) for each row that it completes. A row may be the last of one and the first of another.
    template <class Finished> void add(const float* row, const Finished& finished) {
        if (is_even_)
            halve_even(row);
        else
            halve(row);
        const size_t size = size_t(width_) * 4;
        for (; next_ < terms_.size() && terms_[next_].row == row_; ++next_) {
            const Term& term = terms_[next_];
            if (term.begins)
                for (size_t i = 0; i < size; ++i) sums_[i] = term.share * across_[i];
            else
                for (size_t i = 0; i < size; ++i) sums_[i] += term.share * across_[i];
            if (term.ends) finished(term.y, std::span<const float>(sums_).first(size));
        }
        ++row_;
    }

private:
    // Each cell is the mean of two: the same sums as below, without the third share, which is 0.
    void halve_even(const float* row) {
        float* out = across_.data();
        for (int x = 0; x < width_; ++x, row += 8, out += 4)
            for (size_t c = 0; c < 4; ++c) out[c] = 0.5f * row[c] + 0.5f * row[c + 4];
    }
    void halve(const float* row) {
        float* out = across_.data();
        for (const Cells& cells : columns_) {
            const float* texel = row + 4 * cells.first;
            for (size_t c = 0; c < 4; ++c)
                *out++ = cells.shares[0] * texel[c] + cells.shares[1] * texel[c + 4] + cells.shares[2] * texel[c + 8];
        }
    }

    // Row y of this level has this share of a row above.
    struct Term {
        int y, row;
        float share;
        bool begins = false, ends = false; // row y
    };

    int width_;
    bool is_even_;
    std::vector<Cells> columns_; // of an odd width
    std::vector<Term> terms_;    // by y, and so by row
    size_t next_ = 0;            // term
    int row_ = 0;
    std::vector<float> across_, sums_;
};

// Adds a row of the level before levels[first], and to each further level the rows that this completes.
void add_row(std::span<HalfSize> levels, int first, const float* row, const TakeRow& take) {
    levels[size_t(first)].add(row, [&](int y, std::span<const float> rgba) {
        take(first + 1, y, rgba);
        if (size_t(first) + 1 < levels.size()) add_row(levels, first + 1, rgba.data(), take);
    });
}

} // namespace

int mip_count(int width, int height) { return std::bit_width(unsigned(std::max(width, height))); }

void make_mips(int width, int height, const ReadRow& read, const TakeRow& take) {
    std::vector<HalfSize> levels;
    for (int i = 0; i + 1 < mip_count(width, height); ++i) levels.emplace_back(halved(width, i), halved(height, i));
    std::vector<float> row = texel_row(width);
    for (int y = 0; y < height; ++y) {
        read(y, row.data());
        if (!levels.empty()) add_row(levels, 0, row.data(), take);
    }
}

} // namespace blush
