// Value editors in rows of label and field. They report "changed" and which gesture the change belongs to, so that a
// panel applies one edit per frame and a drag becomes one step of the history. Every number is dragged, finely with Shift, and typed after a
// double-click; Tab goes on to the next. Its menu copies, pastes and resets it.
#pragma once

#include "core/vec.h"
#include "ui/ui_state.h"

#include <cfloat>
#include <cstdint>
#include <imgui.h>
#include <span>
#include <string>

namespace blush {

// How a number is shown and dragged. Limits hold for typed values too.
struct NumberStyle {
    float min = -FLT_MAX, max = FLT_MAX;
    float reset = 0; // the default
    const char* unit = "";
    float step = 0;              // per pixel of a drag; 0: half a per cent of the value, for what spans magnitudes
    bool bar = false;            // a filled bar from min to max in place of a field that is dragged
    const char* tip = "";        // what it does, physically
    const char* format = "%.4g"; // of the number alone
};

class Fields {
public:
    // `scope` goes before each label in the probe: "Light" makes "Light/Intensity".
    Fields(UiState& ui, const char* scope);
    ~Fields();
    Fields(const Fields&) = delete;
    Fields& operator=(const Fields&) = delete;

    bool number(const char* label, float& value, const NumberStyle& style);
    // Shown in degrees, as the style's limits and reset are.
    bool angle(const char* label, float& radians, const NumberStyle& style);
    bool integer(const char* label, int64_t& value, int64_t min, int64_t max, int64_t reset, const char* tip);
    bool vector(const char* label, Vec3& value, const Vec3& reset, const NumberStyle& style);
    // Linear RGB: a swatch with a picker, and the three numbers.
    bool color(const char* label, Vec3& value, const Vec3& reset, const char* tip);
    bool checkbox(const char* label, bool& value, const char* tip);
    bool choice(const char* label, int& index, std::span<const char* const> names, const char* tip);
    bool choice(const char* label, std::string& name, std::span<const std::string> names, const char* tip);
    // Changed when the user is done typing.
    bool text(const char* label, std::string& value, const char* tip);
    void info(const char* label, const std::string& text, const char* tip = "");
    // A name in the field's column, with a button that takes it away; true when that is pressed.
    bool removable(const std::string& name);
    // A button in the field's column.
    bool button(const char* label, const char* tip = "");

    // The label of a row whose field the caller draws; it is as wide as the rest of the row unless another width is set.
    void begin_row(const char* label, const char* tip);
    // A button's press has changed the record: one step of the history.
    void note_change() { changed_ = true; }

    // Anything edited since construction, and the gesture of that edit.
    bool changed() const { return changed_; }
    Gesture gesture() const { return gesture_; }

private:
    bool number_field(const char* id, float& value, const NumberStyle& style);
    // Of the number drawn last: copies, pastes, resets. `all`: the three that it is one of; null: it stands alone.
    bool obey_wish(const std::string& name, float& value, const NumberStyle& style, float reset, Vec3* all, bool color);
    bool obey_color_wish(const char* label, Vec3& value, const Vec3& reset);
    bool draw_picker(const char* label, Vec3& value);
    bool finish(const char* label, const char* tip, bool changed);

    UiState& ui_;
    const char* scope_;
    bool changed_ = false;
    Gesture gesture_ = no_gesture;
};

// A foldable heading over rows; draw them if it returns true.
bool section(UiState& ui, const char* name, bool open_at_first = true);
// A tooltip for the last item, once the mouse has rested on it.
void tip_for_last_item(UiState& ui, const char* tip);
// The mouse has rested on the last item for as long as a tooltip waits; asks for the frame in which that is so.
bool tip_is_due(UiState& ui);
// A tooltip of that size goes beside the window of the last item, never over the row below it.
void place_next_tip(const ImVec2& size);
// A wrapped paragraph in the quiet colour.
void quiet_text(const std::string& text);

} // namespace blush
