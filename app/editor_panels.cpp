#include "app/editor_panels.h"

#include "ui/panels/panels.h"
#include "ui/regions.h"

namespace blush {

void draw_side_panels(PanelContext& c, const Layout& l) {
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
    draw_light_mix_panel(c);
    draw_light_table(c);
}

void InstrumentPanels::draw(PanelContext& c) {
    draw_comparison_panel(c);
    draw_snapshot_panel(c);
    draw_region_panel(c);
    draw_meters_panel(c);
    waveforms_.update(c.ui.scopes);
    draw_scopes_panel(c, waveforms_.textures());
    draw_history(c);
    draw_bounces_panel(c);
    draw_convergence_panel(c);
    draw_roulette_panel(c);
    draw_health_panel(c);
}

} // namespace blush
