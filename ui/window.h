// The GLFW window with its OpenGL context and ImGui's backends: the only file that knows GLFW.
#pragma once

#include "core/result.h"
#include "ui/shortcuts.h"

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

    // Sleeps until there is input, wake() is called or the timeout is over; returns at once while frames are due.
    // False if nothing asks for a frame.
    bool wait(double timeout_seconds);
    // At least this many more frames will be due: ImGui needs a few to settle after input.
    void request_frames(int count);
    // Makes wait() return with a frame due. Callable from any thread while a window is open.
    static void wake();

    // Per cent of the size that the display asks for, of text and all that goes by it. Not within a frame.
    void set_text_size(int per_cent);
    void begin_frame();
    // Draws ImGui's picture over a cleared window and shows it.
    void end_frame();

    bool close_requested() const;
    void request_close();
    void cancel_close();
    void set_title(const std::string& title);
    struct Size {
        int width, height;
    };
    Size size() const; // screen coordinates
    bool maximized() const;
    // On the monitor that most of the window is on; back to the size and place before.
    void toggle_full_screen();
    bool full_screen() const;

    // What was pressed and dropped since the last call, in order. A key that was pressed and released between two frames counts.
    std::vector<KeyPress> take_key_presses() { return std::exchange(key_presses_, {}); }
    std::vector<std::filesystem::path> take_dropped_files() { return std::exchange(dropped_files_, {}); }

private:
    Window() = default;
    void install_callbacks();
    void begin_imgui();
    void apply_scale();

    GLFWwindow* window_ = nullptr;
    bool imgui_ = false;
    Size windowed_{};                  // before it filled the screen
    int windowed_x_ = 0, windowed_y_ = 0;
    float display_scale_ = 1, scale_ = 1; // of the display; of fonts and spacing: that many times their size at 96 dpi
    int text_size_ = 100;                 // per cent
    std::filesystem::path assets_;
    int frames_due_ = 3;
    std::vector<KeyPress> key_presses_;
    std::vector<std::filesystem::path> dropped_files_;
};

} // namespace blush
