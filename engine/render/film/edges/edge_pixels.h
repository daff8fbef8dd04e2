// The pixels of a film that get more samples of the emission that the camera sees: those at edges of emitters, and those with highlights of
// lamps (edge_pilot.h).
#pragma once

#include "render/film/edges/highlight_places.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace blush {

// Emission samples per sample of a pixel: at an edge; with faint images of lamps; with a highlight, which may cover a hundredth of the
// pixel; with a bright one.
constexpr int edge_samples = 16, faint_highlight_samples = 1, highlight_samples = 64, bright_highlight_samples = 512;
// Delta lobes between camera and lamp, for highlights.
constexpr int longest_highlight_chain = 16;

// A number for each pixel; empty without pixels.
class EdgePixels {
public:
    EdgePixels() = default;
    // `longest_chain`: of delta lobes between the camera and the emission; 0: only emission that is seen directly.
    EdgePixels(int width, int height, int longest_chain = 0)
        : width_(width), longest_chain_(longest_chain), samples_(size_t(width) * size_t(height)) {}

    void add(int x, int y, int samples = edge_samples) {
        uint16_t& of = samples_[place(x, y)];
        if (of == 0) ++count_;
        of = std::max(of, uint16_t(samples));
    }
    // Emission samples per sample; 0: none.
    int samples(int x, int y) const { return samples_.empty() ? 0 : samples_[place(x, y)]; }
    bool has(int x, int y) const { return samples(x, y) > 0; }
    // The least number that this pixel and those around it take of the emission for each sample, their own or more: a lamp in it may reach
    // into any of them.
    int fewest_near(int x, int y) const {
        int fewest = samples(x, y);
        const int height = width_ > 0 ? int(samples_.size() / size_t(width_)) : 0;
        for (int v = std::max(0, y - 1); fewest > 1 && v <= std::min(height - 1, y + 1); ++v)
            for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) fewest = std::min(fewest, samples(u, v));
        return std::max(1, fewest);
    }
    // In a rectangle.
    bool any(int x, int y, int width, int height) const {
        for (int v = y; v < y + height; ++v)
            for (int u = x; u < x + width; ++u)
                if (has(u, v)) return true;
        return false;
    }
    // With so many samples.
    int64_t count(int samples) const { return std::ranges::count(samples_, uint16_t(samples)); }
    bool empty() const { return count_ == 0; }
    // Where the emission samples of these pixels aim.
    const HighlightPlaces& places() const { return places_; }
    void aim_at(HighlightPlaces places) { places_ = std::move(places); }
    int longest_chain() const { return longest_chain_; }
    bool operator==(const EdgePixels&) const = default;

private:
    size_t place(int x, int y) const { return size_t(y) * size_t(width_) + size_t(x); }

    int width_ = 0, longest_chain_ = 0;
    int64_t count_ = 0; // of pixels with any
    std::vector<uint16_t> samples_;
    HighlightPlaces places_;
};

} // namespace blush
