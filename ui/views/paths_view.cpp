#include "ui/views/paths_view.h"

#include <algorithm>

namespace blush {

const RecordedPath* PathsView::shown() const {
    const PathSet* traced = set();
    if (!traced || traced->paths.empty()) return nullptr;
    return traced->paths[size_t(std::clamp<int64_t>(path, 0, int64_t(traced->paths.size()) - 1))].get();
}

size_t PathsView::shown_vertices() const {
    const RecordedPath* p = shown();
    if (!p) return 0;
    return steps > 0 ? std::min(size_t(steps), p->vertices.size()) : p->vertices.size();
}

RgbChannel PathsView::channel_of(const RecordedPath& p) const {
    switch (channel) {
    case ShownChannel::brightest: break;
    case ShownChannel::red: return RgbChannel::red;
    case ShownChannel::green: return RgbChannel::green;
    case ShownChannel::blue: return RgbChannel::blue;
    }
    return main_channel(p);
}

std::vector<TracedPixel> traced_pixels(const ImageRegion& region, int width, int height) {
    constexpr int most_side = 8;
    const PixelRect r = pixels_of(region, width, height);
    const int w = r.x1 - r.x0, h = r.y1 - r.y0, columns = std::min(w, most_side), rows = std::min(h, most_side);
    std::vector<TracedPixel> pixels;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            pixels.push_back({r.x0 + (2 * column + 1) * w / (2 * columns), r.y0 + (2 * row + 1) * h / (2 * rows)});
    return pixels;
}

double play(PathsView& view, double now) {
    if (now < view.step_due) return view.step_due - now;
    const double seconds = 1 / double(std::max(view.speed, 0.1f));
    view.step_due = now + seconds;
    const RecordedPath* path = view.shown();
    if (!path) return seconds;
    if (view.steps > 0 && size_t(view.steps) < path->vertices.size())
        ++view.steps;
    else {
        view.steps = 1;
        view.path = view.path + 1 < int64_t(view.set()->paths.size()) ? view.path + 1 : 0;
    }
    return seconds;
}

} // namespace blush
