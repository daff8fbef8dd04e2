// Presentation mode: what the editor changes in the window for a talk, and puts back after it.
#pragma once

#include "ui/panel_context.h"

#include <optional>
#include <string>
#include <vector>

namespace blush {

class Window;

class EditorPresentation {
public:
    // Begins or ends the presentation if the user asked for it. Call once per UI frame.
    void poll(PanelContext c, Window& window);
    // Ends it: the window looks as before it.
    void end(PanelContext c, Window& window);
    // True if the key press belongs to the presentation: 1 to 9 show a snapshot, and the same key again the live image.
    static bool takes(const KeyPress& press, UiState& ui);

private:
    struct Kept {
        bool full_screen = false, panels_hidden = false, strip = false;
        bool lesson = false;
        Dock dock;
        Comparison compare;
        std::vector<std::string> open; // instruments
    };
    void begin(PanelContext& c, Window& window);

    std::optional<Kept> kept_;
};

// Around the widget that the lesson highlights, and at the pointer of a presentation. After everything else is drawn.
void draw_marks(const UiState& ui);

// Per cent, of all text and widgets.
int text_size_shown(const UiState& ui);

} // namespace blush
