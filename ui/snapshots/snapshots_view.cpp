#include "ui/snapshots/snapshots_view.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace blush {

Thumbnail thumbnail_of(const Frame& frame) {
    Thumbnail t;
    t.rgba.assign(size_t(Thumbnail::width) * Thumbnail::height * 4, 0.f);
    if (frame.width < 1 || frame.height < 1) return t;
    const double scale = std::max(double(frame.width) / Thumbnail::width, double(frame.height) / Thumbnail::height);
    const int width = std::clamp(int(frame.width / scale), 1, Thumbnail::width),
              height = std::clamp(int(frame.height / scale), 1, Thumbnail::height);
    const int left = (Thumbnail::width - width) / 2, top = (Thumbnail::height - height) / 2;
    constexpr int taps = 3; // samples along each side of a pixel's footprint: enough for a small image
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float* to = &t.rgba[4 * (size_t(top + y) * Thumbnail::width + size_t(left + x))];
            for (int tap = 0; tap < taps * taps; ++tap) {
                const int fx = std::min(int((x + (tap % taps + 0.5) / taps) * scale), frame.width - 1);
                const int fy = std::min(int((y + (tap / taps + 0.5) / taps) * scale), frame.height - 1);
                const float* from = &frame.rgba[4 * (size_t(fy) * size_t(frame.width) + size_t(fx))];
                for (int c = 0; c < 4; ++c) to[c] += from[c] / float(taps * taps);
            }
        }
    return t;
}

void Snapshot::choose_layer(size_t index) {
    layers->chosen = index;
    images.frame = frame_of(*layers);
    thumbnail = thumbnail_of(*images.frame);
}

std::string Snapshot::figures() const {
    if (layers) return fmt::format("{}, {} layer{}", time, layers->layers.size(), layers->layers.size() == 1 ? "" : "s");
    if (!images.frame) return last_figures_.empty() ? time : last_figures_;
    const Frame& f = *images.frame;
    const std::string relative_error = f.error.known ? fmt::format(", {:.3g} %", 100 * std::sqrt(f.error.relmse)) : std::string();
    return fmt::format("{} spp{}, {}", f.samples, relative_error, time);
}

void Snapshot::unload() {
    last_figures_ = figures();
    images = {};
    error = {};
    film = nullptr;
    place = Place::file;
}

SnapshotPtr SnapshotsView::find(uint64_t id) const {
    const auto it = std::ranges::find(list, id, &Snapshot::id);
    return it == list.end() ? nullptr : *it;
}

uint64_t SnapshotsView::add(Snapshot snapshot) {
    snapshot.id = ++last_id_;
    if (snapshot.name.empty()) snapshot.name = fmt::format("Snapshot {}", snapshot.id);
    use(snapshot);
    list.push_back(std::make_shared<Snapshot>(std::move(snapshot)));
    return last_id_;
}

void SnapshotsView::remove(uint64_t id) {
    removed_ = find(id);
    std::erase(list, removed_);
    if (removed_ && !removed_->file.empty() && (!removed_->film || removed_->film_in_file)) removed_->unload();
    if (compare.a == id || compare.b == id) compare = {.kind = compare.kind};
    if (details == id) details = 0;
}

void SnapshotsView::replace(uint64_t older, uint64_t newer) {
    const auto from = std::ranges::find(list, newer, &Snapshot::id), to = std::ranges::find(list, older, &Snapshot::id);
    if (from == list.end() || to == list.end()) return;
    *to = *from;
    list.erase(from);
    for (uint64_t* id : {&compare.a, &compare.b, &details})
        if (*id == older) *id = newer;
}

void SnapshotsView::put_back() {
    if (!removed_) return;
    const auto place = std::ranges::find_if(list, [&](const SnapshotPtr& s) { return s->id > removed_->id; });
    list.insert(place, std::exchange(removed_, nullptr));
}

bool SnapshotsView::toggle(Comparison::Mode mode) {
    if (compare.mode == mode && mode == Comparison::Mode::flicker) {
        compare.shows_b = !compare.shows_b; // the same key continues the mode
        return true;
    }
    if (compare.mode == mode) {
        compare.mode = Comparison::Mode::off;
        return true;
    }
    if (compare.a == compare.b) {
        if (list.empty()) return false;
        compare.a = list.back()->id;
        compare.b = live_image;
    }
    compare.mode = mode;
    return true;
}

void SnapshotsView::choose(uint64_t& side, uint64_t id) {
    side = id;
    if (compare.a != compare.b && compare.mode == Comparison::Mode::off) compare.mode = Comparison::Mode::wipe;
}

} // namespace blush
