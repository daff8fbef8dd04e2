#include "ui/snapshots/snapshot_memory.h"

#include <algorithm>

namespace blush {
namespace {

template <class T> size_t bytes_of(const std::vector<T>& values) { return values.size() * sizeof(T); }
template <class T> size_t bytes_of(const std::vector<std::vector<T>>& planes) {
    size_t sum = 0;
    for (const std::vector<T>& plane : planes) sum += bytes_of(plane);
    return sum;
}

size_t bytes_of(const Frame& f) {
    return bytes_of(f.rgba) + bytes_of(f.pixel_samples) + bytes_of(f.albedo) + bytes_of(f.normal) + bytes_of(f.depth) +
           bytes_of(f.object_id) + bytes_of(f.material_id) + bytes_of(f.bounces) + bytes_of(f.groups) + bytes_of(f.path_length) +
           bytes_of(f.survival);
}

size_t bytes_of(const DenoisedImage& d) {
    return bytes_of(d.denoised.rgb) + bytes_of(d.with_history.rgb) + (d.groups ? bytes_of(d.groups->planes) : 0);
}

size_t bytes_of(const FilmState& f) {
    size_t sum = bytes_of(f.shares[0]) + bytes_of(f.shares[1]) + bytes_of(f.marked);
    for (const LosslessPlane& plane : f.planes) sum += bytes_of(plane.sums) + bytes_of(plane.low) + bytes_of(plane.words);
    return sum;
}

} // namespace

size_t bytes_of(const Snapshot& s) {
    return (s.images.frame ? bytes_of(*s.images.frame) : 0) + (s.images.denoised ? bytes_of(*s.images.denoised) : 0) + bytes_of(s.error) +
           (s.film ? bytes_of(*s.film) : 0);
}

size_t bytes_of(const std::vector<SnapshotPtr>& list) {
    size_t sum = 0;
    for (const SnapshotPtr& s : list) sum += bytes_of(*s);
    return sum;
}

std::vector<SnapshotPtr> snapshots_to_unload(const SnapshotsView& view, size_t limit) {
    size_t sum = bytes_of(view.list);
    std::vector<SnapshotPtr> by_use = view.list, leaving;
    std::ranges::sort(by_use, {}, &Snapshot::last_used);
    if (!by_use.empty()) by_use.pop_back();
    for (const SnapshotPtr& s : by_use) {
        if (sum <= limit) break;
        const size_t bytes = bytes_of(*s);
        if (s->pinned || bytes == 0 || view.compares(s->id)) continue;
        sum -= bytes;
        leaving.push_back(s);
    }
    return leaving;
}

} // namespace blush
