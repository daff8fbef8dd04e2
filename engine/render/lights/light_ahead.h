// The light that paths of a tile find behind their vertices.
#pragma once

#include <cstddef>
#include <vector>

namespace blush {

// One entry for each vertex that is noted, in order.
class LightAhead {
public:
    void add(int slot) { open_.push_back({slot, 0}); }
    // Call when the light that arrives at the last vertices has been added to the slots: later light comes from the directions that were
    // sampled at the vertices added since the last call. `radiance(slot)`: luminance so far.
    template <class Radiance> void note_arrived(const Radiance& radiance) {
        for (; noted_ < open_.size(); ++noted_) open_[noted_].before = radiance(open_[noted_].slot);
    }
    // Call at the end of the tile: visits (k, slot, luminance of the light ahead) for each vertex, and forgets them.
    template <class Radiance, class Visit> void finish(const Radiance& radiance, const Visit& visit) {
        for (size_t k = 0; k < open_.size(); ++k) visit(k, open_[k].slot, radiance(open_[k].slot) - open_[k].before);
        open_.clear();
        noted_ = 0;
    }
    size_t size() const { return open_.size(); }

private:
    struct Vertex {
        int slot;
        double before; // luminance of the slot's radiance at the vertex
    };
    std::vector<Vertex> open_;
    size_t noted_ = 0;
};

} // namespace blush
