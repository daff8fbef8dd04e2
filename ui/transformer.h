// A transform of the selection under way in the viewport: it follows mouse and keys, shows what it does and edits the document, as one step.
#pragma once

#include "ui/panels/context.h"
#include "ui/transform_edits.h"

#include <imgui.h>
#include <optional>

namespace blush {

class Transformer {
public:
    // Begins what is asked for and goes on with what is under way. True while one is: all of the mouse and the keys are then its own.
    bool update(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& image);
    // Nothing is asked for any more, and what was under way is taken back.
    void abandon(PanelContext& c);
    bool under_way() const { return tool_.has_value(); }

private:
    void begin(PanelContext& c, const TransformRequest& request, const Projection& projection, const ImageRect& image);
    void end(PanelContext& c, bool confirmed);
    // Confirmed or cancelled; nothing: it goes on.
    std::optional<bool> hear(PanelContext& c);
    void apply(PanelContext& c);
    void draw_axes(ImDrawList& draw, const Projection& projection, const ImageRect& image) const;

    std::optional<TransformTool> tool_;
    std::vector<TransformTarget> targets_;
    std::optional<Motion> applied_;
    std::string problem_; // why the mode it is in changes nothing; empty: it does
    Gesture gesture_ = no_gesture;
    bool by_drag_ = false;
};

} // namespace blush
