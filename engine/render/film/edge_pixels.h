// A set of pixels of a film: those at edges of visible emitters (edge_pilot.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace blush {

// A bitmap; empty without pixels.
class EdgePixels {
public:
    EdgePixels() = default;
    EdgePixels(int width, int height) : width_(width), bits_(size_t(width) * size_t(height)) {}

    void add(int x, int y) {
        if (!bits_[place(x, y)]) ++count_;
        bits_[place(x, y)] = true;
    }
    bool has(int x, int y) const { return count_ > 0 && bits_[place(x, y)]; }
    // In a rectangle.
    bool any(int x, int y, int width, int height) const {
        for (int v = y; v < y + height; ++v)
            for (int u = x; u < x + width; ++u)
                if (has(u, v)) return true;
        return false;
    }
    int64_t count() const { return count_; }
    bool operator==(const EdgePixels&) const = default;

private:
    size_t place(int x, int y) const { return size_t(y) * size_t(width_) + size_t(x); }

    int width_ = 0;
    int64_t count_ = 0;
    std::vector<bool> bits_;
};

} // namespace blush
