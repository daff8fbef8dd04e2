// The history strip: snapshots in a row below the picture.
#pragma once

#include "ui/display_pass.h"
#include "ui/layout.h"
#include "ui/panels/context.h"

#include <imgui.h>

#include <functional>
#include <optional>
#include <vector>

namespace blush {

// Where a snapshot's picture is to be drawn from; a texture of 0 draws none.
struct ThumbnailPart {
    ImTextureID texture = {};
    float v0 = 0, v1 = 1;
};

// The strip in its region; `part(index)` says where the thumbnail of list[index] is.
void draw_snapshot_strip(PanelContext& c, const Region& region, const std::function<ThumbnailPart(size_t)>& part);

// The height that it wants, in pixels; 0 while there is none to be seen.
float snapshot_strip_height(const SnapshotsView& view);

// Takes it out of the strip; a message offers to put it back.
void delete_snapshot(PanelContext& c, const Snapshot& snapshot);

// All thumbnails in one texture, one above the other, drawn again when one comes, goes or is looked at in another way.
class ThumbnailSheet {
public:
    void set_shader(const DisplayShader& shader);
    void update(const std::vector<SnapshotPtr>& list, const DisplayNumbers& numbers);
    ThumbnailPart part(size_t index) const;

private:
    DisplayPass pass_;
    std::optional<DisplayShader> shader_;
    bool shader_changed_ = false;
    DisplayLook look_;
    std::vector<uint64_t> ids_; // of what it shows
};

} // namespace blush
