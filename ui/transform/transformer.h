// The active transform of the selection in the viewport: reads mouse and keys, shows its amount and edits the document, as one
// undo step.
#pragma once

#include "ui/panel_context.h"
#include "ui/transform/transform_edits.h"

#include <imgui.h>
#include <optional>

namespace blush {

class Transformer {
public:
    // Starts a requested transform and continues the active one. True while one is active: it then uses all mouse and key input.
    bool update(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& image);
    // Drops a request and cancels the active transform.
    void cancel(PanelContext& c);
    bool is_active() const { return tool_.has_value(); }

private:
    void begin(PanelContext& c, const TransformRequest& request, const Projection& projection, const ImageRect& image);
    void end(PanelContext& c, bool confirmed);
    // true: confirmed, false: cancelled; nullopt: still active
    std::optional<bool> confirmation(PanelContext& c);
    void apply(PanelContext& c);
    void draw_axes(ImDrawList& draw, const Projection& projection, const ImageRect& image) const;

    std::optional<TransformTool> tool_;
    std::vector<TransformTarget> targets_;
    std::optional<Motion> applied_;
    std::string problem_; // why the mode has no effect; empty: it has one
    Gesture gesture_ = no_gesture;
    bool by_drag_ = false;
};

} // namespace blush
