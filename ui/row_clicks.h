// Clicks on rows that stand for nodes, in outliner and tables: plain selects, Ctrl adds or takes away, Shift selects all up to there.
#pragma once

#include "ui/ui_state.h"

namespace blush {

class RowClicks {
public:
    // For each row in the order in which they are shown; `clicked`: its item was, in this frame.
    void row(Id<Node> node, bool clicked, Id<Material> material = {});
    // After the last one.
    void finish(UiState& ui) const;

private:
    std::vector<Id<Node>> listed_;
    Id<Node> clicked_;
    Id<Material> material_;
};

} // namespace blush
