// Places on the film where a lamp is seen in smooth surfaces, for samples of the emission that aim at them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace blush {

struct FilterTable;

// A parallelogram that contains the image of a lamp, or a part of it. Positions are in pixels, y downwards; a pixel (x, y) has its centre
// at (x + 1/2, y + 1/2).
struct HighlightPlace {
    double x, y;           // of its centre
    double ax, ay, bx, by; // its half axes
    double light;          // luminance that it adds to a sample, nits
    double area() const;   // square pixels
    bool contains(double at_x, double at_y) const;
    bool operator==(const HighlightPlace&) const = default;
};

// A highlight that covers a thousandth of a pixel is met by one sample in a thousand. Where the places of highlights are known, half of the
// samples of the emission aim at them (one-sample MIS, Veach 1997, section 9.2.4). With f the density of the pixel filter at a position and
// p_i the uniform density of place i, selected with the probability w_i,
//
//     q = f / 2 + sum_i w_i p_i / 2,
//
// and a sample counts f / q, which is at most 2. The mean stays the same whatever the places are.
class HighlightPlaces {
public:
    HighlightPlaces() = default;
    // For a film of width x height pixels whose samples have the positions of `filter`.
    HighlightPlaces(std::span<const HighlightPlace> places, int width, int height, const FilterTable& filter);

    bool empty() const { return pixels_.empty(); }
    // True if samples of this pixel aim at a place.
    bool aims(int x, int y) const { return !near(x, y).empty(); }
    // Calls take(x, y, light) for each pixel that meets a place and the largest light of these places, nits: row by row.
    template <class Take> void for_each_pixel(const Take& take) const {
        for (const Pixel& p : pixels_) take(p.x, p.y, p.light);
    }

    struct Sample {
        double x, y;   // on the film
        double weight; // f / q; -1: the pixel has no place, and the sample no position
    };
    // A sample of a pixel. u, v: uniform in [0, 1).
    Sample sample(int x, int y, double u, double v, const FilterTable& filter) const;

    bool operator==(const HighlightPlaces&) const = default;

private:
    // A place of a pixel; `bound`: upper end of its interval of selection probabilities.
    struct Near {
        HighlightPlace place;
        double probability, bound;
        bool operator==(const Near&) const = default;
    };
    struct Pixel {
        int x, y;
        double light;
        size_t first, count; // in near_
        bool operator==(const Pixel&) const = default;
    };
    std::span<const Near> near(int x, int y) const;

    std::vector<Pixel> pixels_; // row by row
    std::vector<Near> near_;
};

// Columns of samples: their pixels; uniform random numbers in [0, 1), which become positions on the film; and the weights.
struct AimedColumns {
    const float *pixel_x, *pixel_y;
    float *x, *y, *weight;
};
// Aims the samples of pixels with places at them. Others get the weight -1, and no position.
void aim_samples(const HighlightPlaces& places, const FilterTable& filter, int count, const AimedColumns& samples);

} // namespace blush
