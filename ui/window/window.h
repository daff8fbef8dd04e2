// The GLFW window with its OpenGL context and ImGui's backends: the only file that uses GLFW.
#pragma once

#include "core/result.h"
#include "ui/gl/redraw.h"
#include "ui/window/shortcuts.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

struct GLFWwindow;

namespace blush {

struct WindowOptions {
    std::string title = "Blush";
    int width = 1280, height = 800; // screen coordinates
    bool maximized = false;
    float scale = 0;              // of fonts and spacing; 0: the display's content scale
    std::filesystem::path assets; // for fonts
};

class Window {
public:
    // Errors: no display, no OpenGL 3.3.
    static Result<std::unique_ptr<Window>> open(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Sleeps until input, wake() or the timeout; returns at once while frames are pending.
    // False if no frame is needed.
    bool wait(double timeout_seconds);
    // Requests at least this many more frames: ImGui needs a few to settle after input.
    void request_frames(int count);
    // Makes wait() return with a frame pending. Thread-safe while a window is open.
    static void wake();

    // Text and UI size in per cent of the display's default, which changes when the window moves to another display. Call it before
    // each frame.
    void set_text_size(int per_cent);
    // While on, a cursor that reaches an edge of the window goes on at the opposite edge. ImGui's mouse position goes on without a
    // jump, beyond the window, so that a drag has no end. No effect where programs must not move the cursor (Wayland).
    void wrap_cursor(bool on);
    void begin_frame();
    // Renders ImGui's draw data over a cleared window and swaps the buffers. Returns false, and draws nothing, if the window
    // shows the same already.
    bool end_frame();

    bool frames_due() const { return frames_due_ > 0; }
    // Number of presses and releases of keys and mouse buttons and turns of the wheel, as of the last frame after which no frame was
    // pending: ImGui has settled after them.
    uint64_t settled_inputs() const { return settled_inputs_; }

    bool close_requested() const;
    void request_close();
    void cancel_close();
    void set_title(const std::string& title);
    struct Size {
        int width, height;
    };
    Size size() const; // screen coordinates
    bool maximized() const;
    // Switches to full screen on the monitor that shows most of the window, and back to the previous size and place.
    void toggle_full_screen();
    bool full_screen() const;

    // Keys pressed and files dropped since the last call, in order. Includes keys that were pressed and released between two
    // frames.
    std::vector<KeyPress> take_key_presses() { return std::exchange(key_presses_, {}); }
    std::vector<std::filesystem::path> take_dropped_files() { return std::exchange(dropped_files_, {}); }

private:
    Window() = default;
    void install_callbacks();
    void begin_imgui();
    void apply_scale();
    void unwrap_mouse();
    void take_input(bool counts);
    // As request_frames(), and the first of them is drawn even if it looks like the last one.
    void must_draw(int frames);

    GLFWwindow* window_ = nullptr;
    bool imgui_ = false;
    Size windowed_{}; // size before full screen
    int windowed_x_ = 0, windowed_y_ = 0;
    float display_scale_ = 1, scale_ = 1; // of the display; of fonts and spacing, relative to 96 dpi
    bool scale_is_given_ = false;         // WindowOptions::scale replaces the display's
    std::filesystem::path assets_;
    bool wraps_cursor_ = false;
    double unwrapped_x_ = 0, unwrapped_y_ = 0; // from the cursor to ImGui's mouse position
    int frames_due_ = 3;
    uint64_t inputs_ = 0, settled_inputs_ = 0;
    Redraw redraw_;
    std::vector<KeyPress> key_presses_;
    std::vector<std::filesystem::path> dropped_files_;
};

} // namespace blush
