// Downscales an image row by row, so that the full image need not be in memory.
#pragma once

#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace blush {

class ImageShrinker {
public:
    struct Source {
        int width = 0, height = 0, channels = 0; // 1..4; the last of 2 or 4 is alpha
        bool is_float = false;
        bool is_srgb = false; // colour only, not alpha
    };
    // Halves the sides `halvings` times, not below one pixel.
    ImageShrinker(const Source& source, int halvings);

    // Adds further complete rows of the source, from the top, in its type.
    void add(std::span<const uint8_t> rows);
    void add(std::span<const float> rows);
    // The result; call it after all rows were added.
    ImagePtr image() &&;

private:
    template <class T> void add_rows(std::span<const T> rows);
    template <class T> void add_row(const T* row);
    void finish_row();
    bool is_color(int channel) const { return channel < (source_.channels < 3 ? 1 : 3); }

    Source source_;
    Image image_;
    int rows_ = 0;                         // added
    std::array<float, 256> byte_values_{}; // decoded colour values
    std::vector<float> across_;            // current source row at the new width
    std::vector<float> now_, next_;        // partial sums of result rows: a source row overlaps at most two
};

} // namespace blush
