// Which AOV the viewport shows, and the list of AOVs to choose from.
#pragma once

#include "render/film/film_size.h"
#include "render/film/found_by.h"
#include "render/frame.h"
#include "ui/snapshots/image_view.h"

#include <string>
#include <vector>

namespace blush {

struct AovView {
    ImageView::Show show = ImageView::Show::beauty;
    int index = 0; // of the bounce, the group or the strategy
    bool operator==(const AovView&) const = default;
};

struct AovEntry {
    AovView view;
    std::string name;
    std::string needs = {}; // why the AOV is not available yet; empty: it is available
    bool possible = true;   // false: only the user can provide the missing data
};
// All AOVs: beauty, first-hit data, error, samples, one per light group of the frame, one per bounce, the two piles of
// direct and indirect light, and one per strategy. With a null frame, the list has no groups.
std::vector<AovEntry> aov_list(const Frame* frame);
std::string strategy_name(FoundBy by);
// True if it shows bounce planes, or is computed from them.
bool needs_bounces(ImageView::Show show);
// Its name in the list.
std::string name_of(const AovView& view, const Frame* frame);
// The entry `steps` further in the list, cyclically, skipping impossible ones.
AovView stepped(const AovView& view, const Frame* frame, int by);

// `bounce_planes`: number in the frame.
ImageView image_view(const AovView& view, int bounce_planes);
// The film planes that it needs in addition to the default ones. None for the beauty.
PlaneSet planes_of(const AovView& view);

} // namespace blush
