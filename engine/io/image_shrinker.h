// Makes an image smaller while its rows arrive, so that it need not be in memory as a whole.
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
        int width = 0, height = 0, channels = 0; // 1..4; the second of two and the fourth of four is alpha
        bool is_float = false;
        bool is_srgb = false; // its colour, not its alpha
    };
    // Sides are halved that often, not below one pixel.
    ImageShrinker(const Source& source, int halvings);

    // Further rows of the source, from the top: whole ones, of its type.
    void add(std::span<const uint8_t> rows);
    void add(std::span<const float> rows);
    // When all rows have been added.
    ImagePtr image() &&;

private:
    template <class T> void add_rows(std::span<const T> rows);
    template <class T> void add_row(const T* row);
    void finish_row();
    bool is_color(int channel) const { return channel < (source_.channels < 3 ? 1 : 3); }

    Source source_;
    Image image_;
    int rows_ = 0;                  // added
    std::array<float, 256> byte_values_{}; // of colour
    std::vector<float> across_;     // the row at hand, at the new width
    std::vector<float> now_, next_; // rows of the result as far as they are known: a row of the source lies on two at most
};

} // namespace blush
