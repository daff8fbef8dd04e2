// The snapshot strip: snapshots in a row below the image.
#pragma once

#include "ui/gl/display_pass.h"
#include "ui/panel_context.h"
#include "ui/window/layout.h"

#include <imgui.h>

#include <functional>
#include <optional>
#include <vector>

namespace blush {

// Texture and rectangle of a snapshot's thumbnail; texture 0 draws nothing.
struct ThumbnailPart {
    ImTextureID texture = {};
    float v0 = 0, v1 = 1;
};

// Draws the strip in its region; `part(index)` returns the thumbnail of list[index].
void draw_snapshot_strip(PanelContext& c, const Region& region, const std::function<ThumbnailPart(size_t)>& part);

// Its height in pixels; 0 if it is hidden.
float snapshot_strip_height(const SnapshotsView& view);

// Removes it from the strip; a toast offers to restore it.
void delete_snapshot(PanelContext& c, const Snapshot& snapshot);

// All thumbnails in one texture, stacked vertically. Redrawn if the list or the view settings change.
class ThumbnailSheet {
public:
    void set_shader(const DisplayShader& shader);
    void update(const std::vector<SnapshotPtr>& list, const DisplayParameters& numbers);
    ThumbnailPart part(size_t index) const;

private:
    DisplayPass pass_;
    std::optional<DisplayShader> shader_;
    bool shader_changed_ = false;
    DisplayLook look_;
    std::vector<uint64_t> ids_; // of the thumbnails in the texture
};

} // namespace blush
