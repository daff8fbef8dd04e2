// Which plane of the film the viewport shows, and the list it is chosen from: render passes, or AOVs.
#pragma once

#include "render/renderer.h"
#include "ui/picture_view.h"

#include <string>
#include <vector>

namespace blush {

struct AovView {
    PictureView::Show show = PictureView::Show::beauty;
    int index = 0; // of bounces and groups
    bool operator==(const AovView&) const = default;
};

struct AovEntry {
    AovView view;
    std::string name;
    std::string needs = {}; // what it takes to see it, if the picture lacks it now; empty: it is there
    bool possible = true;   // false: `needs` is up to the user
};
// All there are: beauty, first hits, error, samples, one for each group of lights of the frame and for each bounce. A null frame has the same
// list without groups.
std::vector<AovEntry> aov_list(const Frame* frame);
// The name of one of them in the list.
std::string name_of(const AovView& view, const Frame* frame);
// The entry that is so many further in the list, round its end, leaving out those that are not possible.
AovView stepped(const AovView& view, const Frame* frame, int by);

// `bounce_planes`: of the frame.
PictureView picture_view(const AovView& view, int bounce_planes);
// Film planes it needs beside those that every frame has. Nothing for the beauty.
PlaneSet planes_of(const AovView& view);

} // namespace blush
