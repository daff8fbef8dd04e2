// Value fields in rows of label and field. They report "changed" and the gesture of the change, so that a panel applies one edit
// per frame and a drag becomes one undo step. Numbers are dragged (finely with Shift) or typed after a double-click; Tab moves to
// the next field. The context menu copies, pastes and resets.
#pragma once

#include "core/vec.h"
#include "ui/window/ui_state.h"

#include <cfloat>
#include <cstdint>
#include <imgui.h>
#include <span>
#include <string>

namespace blush {

// Format and drag behaviour of a number. Limits also apply to typed values.
struct NumberStyle {
    float min = -FLT_MAX, max = FLT_MAX;
    float reset = 0; // the default
    const char* unit = "";
    float step = 0;          // per pixel of a drag; 0: 0.5 % of the value, for large ranges
    bool bar = false;        // a filled bar from min to max instead of a drag field
    const char* tip = "";    // tooltip: its physical meaning
    const char* format = ""; // without the unit; "": as number_format()
    bool fraction = false;   // below 1 shown as 1/N, in every format
};

class Fields {
public:
    // `scope` is the prefix of each label in the probe: "Light" makes "Light/Intensity".
    Fields(UiState& ui, const char* scope);
    ~Fields();
    Fields(const Fields&) = delete;
    Fields& operator=(const Fields&) = delete;

    bool number(const char* label, float& value, const NumberStyle& style);
    // Shown in degrees; the style's limits and reset are in degrees as well.
    bool angle(const char* label, float& radians, const NumberStyle& style);
    bool integer(const char* label, int64_t& value, int64_t min, int64_t max, int64_t reset, const char* tip);
    bool vector(const char* label, Vec3& value, const Vec3& reset, const NumberStyle& style);
    // Linear RGB: a swatch with a colour picker, and three numbers.
    bool color(const char* label, Vec3& value, const Vec3& reset, const char* tip);
    bool checkbox(const char* label, bool& value, const char* tip);
    bool choice(const char* label, int& index, std::span<const char* const> names, const char* tip);
    bool choice(const char* label, std::string& name, std::span<const std::string> names, const char* tip);
    // Returns true when the user has finished typing.
    bool text(const char* label, std::string& value, const char* tip);
    void info(const char* label, const std::string& text, const char* tip = "");
    // A name in the field column with a remove button; true when that is pressed.
    bool removable(const std::string& name);
    // A button in the field column.
    bool button(const char* label, const char* tip = "");

    // The label of a row whose field the caller draws. The next item's width is the rest of the row unless set otherwise.
    void begin_row(const char* label, const char* tip);
    // The press of a button has changed the record: one undo step.
    void note_change() { changed_ = true; }

    // True if any field was edited since construction; and the gesture of that edit.
    bool changed() const { return changed_; }
    Gesture gesture() const { return gesture_; }

private:
    bool number_field(const char* id, float& value, const NumberStyle& style);
    // Clipboard actions for the number drawn last. `all`: the three numbers it belongs to; null: it is single.
    bool apply_value_action(const std::string& name, float& value, const NumberStyle& style, float reset, Vec3* all, bool color);
    bool apply_color_action(const char* label, Vec3& value, const Vec3& reset);
    bool draw_picker(const char* label, Vec3& value);
    bool finish(const char* label, const char* tip, bool changed);

    UiState& ui_;
    const char* scope_;
    bool changed_ = false;
    Gesture gesture_ = no_gesture;
};

// Call after a number that is dragged: the drag goes on beyond the edges of the window.
void wrap_cursor_if_dragged(UiState& ui);
// A collapsible heading; draw its rows if it returns true.
bool section(UiState& ui, const char* name, bool open_at_first = true);
// A wrapped paragraph in the dim text colour.
void quiet_text(const std::string& text);

} // namespace blush
