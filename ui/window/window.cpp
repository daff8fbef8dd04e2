#include "ui/window/window.h"

#include "ui/gl/overdraw.h"
#include "ui/window/imgui_state.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <epoxy/gl.h>
// Included after epoxy, which replaces the system's OpenGL header.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

namespace blush {
namespace {

static_assert(key::space == GLFW_KEY_SPACE && key::zero == GLFW_KEY_0 && key::escape == GLFW_KEY_ESCAPE && key::enter == GLFW_KEY_ENTER &&
              key::tab == GLFW_KEY_TAB && key::backspace == GLFW_KEY_BACKSPACE && key::pad_zero == GLFW_KEY_KP_0 &&
              key::pad_point == GLFW_KEY_KP_DECIMAL && key::pad_minus == GLFW_KEY_KP_SUBTRACT && key::pad_enter == GLFW_KEY_KP_ENTER &&
              key::remove == GLFW_KEY_DELETE && key::up == GLFW_KEY_UP && key::down == GLFW_KEY_DOWN && key::left == GLFW_KEY_LEFT &&
              key::right == GLFW_KEY_RIGHT && key::home == GLFW_KEY_HOME && key::f1 == GLFW_KEY_F1);

constexpr int frames_after_input = 3;

std::atomic<bool> woken = false;
std::string glfw_error; // GLFW reports errors on the calling thread, which is this one

Window& owner(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

// The monitor that shows most of the window; null if there is none.
GLFWmonitor* monitor_of(GLFWwindow* window) {
    int x = 0, y = 0, width = 0, height = 0, count = 0;
    glfwGetWindowPos(window, &x, &y);
    glfwGetWindowSize(window, &width, &height);
    GLFWmonitor* const* const monitors = glfwGetMonitors(&count);
    GLFWmonitor* best = glfwGetPrimaryMonitor();
    int64_t largest = 0;
    for (int i = 0; i < count; ++i) {
        int left = 0, top = 0;
        glfwGetMonitorPos(monitors[i], &left, &top);
        const GLFWvidmode* const mode = glfwGetVideoMode(monitors[i]);
        if (!mode) continue;
        const int64_t across = std::max(0, std::min(x + width, left + mode->width) - std::max(x, left));
        const int64_t down = std::max(0, std::min(y + height, top + mode->height) - std::max(y, top));
        if (across * down <= largest) continue;
        largest = across * down;
        best = monitors[i];
    }
    return best;
}

float usable_scale(float scale) { return std::clamp(scale, 0.5f, 4.f); }

// Wraps a position at the edges of [0, size): one at an edge goes to the opposite side, others stay.
double away_from_edges(double at, double size) {
    constexpr double edge = 2;
    if (size < 10 * edge || (at >= edge && at < size - edge)) return at;
    const double range = size - 3 * edge, turns = std::floor((at - edge) / range);
    return at - range * turns;
}

} // namespace

Result<std::unique_ptr<Window>> Window::open(const WindowOptions& options) {
    glfwSetErrorCallback([](int, const char* text) { glfw_error = text; });
    if (!glfwInit()) return Error{"", "cannot open the display: " + glfw_error, ""};
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    // The window tests no depths. Without these buffers a software rasterizer skips pixels that an opaque image covers.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_MAXIMIZED, options.maximized);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "blush");
    std::unique_ptr<Window> window(new Window);
    window->window_ = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    if (!window->window_) return Error{"", "cannot create a window with OpenGL 3.3: " + glfw_error, ""};
    glfwMakeContextCurrent(window->window_);
    glfwSwapInterval(1);
    glfwSetWindowSizeLimits(window->window_, 480, 320, GLFW_DONT_CARE, GLFW_DONT_CARE);
    float scale_x = 1, scale_y = 1;
    glfwGetWindowContentScale(window->window_, &scale_x, &scale_y);
    window->scale_is_given_ = options.scale > 0;
    window->display_scale_ = window->scale_ = usable_scale(options.scale > 0 ? options.scale : std::max(scale_x, scale_y));
    window->assets_ = options.assets;
    window->install_callbacks();
    window->begin_imgui();
    return window;
}

Window::~Window() {
    if (imgui_) {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    if (window_) glfwDestroyWindow(window_);
    glfwTerminate();
}

// Our callbacks come first: ImGui's backend chains to the previously installed ones.
void Window::install_callbacks() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int code, int, int action, int mods) {
        owner(w).take_input(action != GLFW_REPEAT);
        if (action == GLFW_RELEASE) return;
        const bool letter_repeats = action == GLFW_REPEAT && !(mods & GLFW_MOD_CONTROL);
        if (!letter_repeats)
            owner(w).key_presses_.push_back(
                {code, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_ALT) != 0});
    });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** files) {
        owner(w).request_frames(frames_after_input);
        owner(w).dropped_files_.insert(owner(w).dropped_files_.end(), files, files + count);
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int, int, int) { owner(w).take_input(true); });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double, double) { owner(w).request_frames(1); });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double) { owner(w).take_input(true); });
    // The character event follows the press of its key.
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned character) {
        owner(w).request_frames(frames_after_input);
        if (!owner(w).key_presses_.empty()) owner(w).key_presses_.back().typed = character;
    });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int) { owner(w).request_frames(frames_after_input); });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int) { owner(w).request_frames(frames_after_input); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { owner(w).must_draw(frames_after_input); });
    glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* w, float x, float y) {
        if (owner(w).scale_is_given_) return;
        owner(w).display_scale_ = usable_scale(std::max(x, y)); // set_text_size() does the rest
        owner(w).request_frames(frames_after_input);
    });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { owner(w).must_draw(1); });
    glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) { owner(w).request_frames(1); });
}

void Window::begin_imgui() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;              // the layout is saved by the application
    ImGui::GetIO().ConfigInputTextCursorBlink = false; // a blinking cursor would prevent the window from sleeping
    apply_scale();
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
    imgui_ = true;
}

// Fonts are rasterized again for each size: scaled glyphs would be blurred.
void Window::apply_scale() {
    ImGui::GetIO().Fonts->Clear();
    load_fonts(assets_, scale_);
    apply_theme(scale_);
}

void Window::set_text_size(int per_cent) {
    const float scale = display_scale_ * (float(per_cent) / 100);
    if (scale == scale_) return;
    scale_ = scale;
    apply_scale();
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
    must_draw(frames_after_input);
}

bool Window::wait(double timeout_seconds) {
    if (frames_due_ > 0)
        glfwPollEvents();
    else
        glfwWaitEventsTimeout(timeout_seconds);
    if (woken.exchange(false)) request_frames(1);
    return frames_due_ > 0;
}

void Window::request_frames(int count) { frames_due_ = std::max(frames_due_, count); }

void Window::take_input(bool counts) {
    inputs_ += counts;
    request_frames(frames_after_input);
}

void Window::must_draw(int frames) {
    redraw_.force();
    request_frames(frames);
}

void Window::wake() {
    woken = true;
    glfwPostEmptyEvent();
}

void Window::wrap_cursor(bool on) {
    wraps_cursor_ = on;
    if (!on) unwrapped_x_ = unwrapped_y_ = 0;
}

void Window::unwrap_mouse() {
    ImGuiIO& io = ImGui::GetIO();
    if (!wraps_cursor_ || !glfwGetWindowAttrib(window_, GLFW_FOCUSED)) return;
    double x = 0, y = 0;
    glfwGetCursorPos(window_, &x, &y);
    const double inside_x = away_from_edges(x, io.DisplaySize.x), inside_y = away_from_edges(y, io.DisplaySize.y);
    if (inside_x != x || inside_y != y) {
        glfwSetCursorPos(window_, inside_x, inside_y);
        double moved_x = 0, moved_y = 0; // the cursor may have stayed: the display server decides
        glfwGetCursorPos(window_, &moved_x, &moved_y);
        unwrapped_x_ += x - moved_x;
        unwrapped_y_ += y - moved_y;
        x = moved_x;
        y = moved_y;
    }
    io.MousePos = {float(x + unwrapped_x_), float(y + unwrapped_y_)};
}

void Window::begin_frame() {
    frames_due_ = std::max(frames_due_ - 1, 0);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    unwrap_mouse();
    navigate_popups_by_keys();
    ImGui::NewFrame();
}

bool Window::end_frame() {
    ImGui::Render();
    ImDrawData& drawn = *ImGui::GetDrawData();
    if (needs_another_frame()) request_frames(1);
    if (frames_due_ == 0) settled_inputs_ = inputs_;
    if (!redraw_.is_needed(drawn)) return false;
    reduce_overdraw(drawn);
    // The size at the start of the frame: another query would wait for the display server.
    glViewport(0, 0, GLsizei(drawn.DisplaySize.x * drawn.FramebufferScale.x), GLsizei(drawn.DisplaySize.y * drawn.FramebufferScale.y));
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0.11f, 0.11f, 0.11f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(&drawn);
    glfwSwapBuffers(window_);
    return true;
}

bool Window::close_requested() const { return glfwWindowShouldClose(window_); }
void Window::request_close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void Window::cancel_close() { glfwSetWindowShouldClose(window_, GLFW_FALSE); }
void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }
bool Window::maximized() const { return glfwGetWindowAttrib(window_, GLFW_MAXIMIZED); }

bool Window::full_screen() const { return glfwGetWindowMonitor(window_) != nullptr; }

void Window::toggle_full_screen() {
    request_frames(frames_after_input);
    if (full_screen())
        return glfwSetWindowMonitor(window_, nullptr, windowed_x_, windowed_y_, windowed_.width, windowed_.height, GLFW_DONT_CARE);
    GLFWmonitor* const monitor = monitor_of(window_);
    const GLFWvidmode* const mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (!mode) return;
    windowed_ = size();
    glfwGetWindowPos(window_, &windowed_x_, &windowed_y_);
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

Window::Size Window::size() const {
    Size s{};
    glfwGetWindowSize(window_, &s.width, &s.height);
    return s;
}

} // namespace blush
