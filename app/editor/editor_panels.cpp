#include "app/editor/editor_panels.h"

#include "ui/panels/instruments.h"
#include "ui/panels/panels.h"
#include "ui/snapshots/snapshot_strip.h"
#include "ui/viewport/regions.h"
#include "ui/window/docks.h"

#include <cmath>

namespace blush {

Layout window_layout(PanelContext& c, float width, float height) {
    const float row = ImGui::GetFrameHeight(), em = ImGui::GetFontSize(), status = std::round(row * 1.25f);
    if (c.ui.panels_hidden) return lay_out(width, height, row, status, em, no_side_panels);
    const bool presents = c.ui.presentation.on;
    const Splitters& splitters = presents ? no_side_panels : c.ui.settings.splitters;
    const float time = c.scene().clips.empty() || presents ? 0 : std::round(row * 1.5f);
    ViewportInsets beside = dock_insets(c, instruments_in_sight(instruments(), c), lay_out(width, height, row, status, em, splitters).room);
    beside.strip = presents ? 0 : snapshot_strip_height(c.ui.snapshots);
    beside.time = time;
    return lay_out(width, height, row, status, em, splitters, beside);
}

void draw_side_panels(PanelContext& c, const Layout& l) {
    if (c.ui.presentation.on) return draw_docks(c, instruments_in_sight(instruments(), c), l);
    drag_splitters(c.ui, l, ImGui::GetIO().DisplaySize.x);
    begin_region("Outliner", l.outliner);
    draw_outliner(c);
    end_region();
    if (l.time.height > 0) {
        begin_region("Time", l.time);
        draw_time(c);
        end_region();
    }
    begin_region("Inspector", l.inspector, {.padded = false});
    draw_inspector(c);
    end_region();
    draw_docks(c, instruments(), l);
}

} // namespace blush
