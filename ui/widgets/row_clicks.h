// Selection by clicks on rows of nodes, in outliner and tables: plain selects, Ctrl toggles, Shift selects a range.
#pragma once

#include "ui/window/ui_state.h"

namespace blush {

class RowClicks {
public:
    // Call for each row in display order; `clicked`: its item was clicked in this frame.
    void row(Id<Node> node, bool clicked, Id<Material> material = {});
    // Call after the last row.
    void finish(UiState& ui) const;

private:
    std::vector<Id<Node>> listed_;
    Id<Node> clicked_;
    Id<Material> material_;
};

} // namespace blush
