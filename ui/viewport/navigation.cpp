#include "ui/viewport/navigation.h"

#include "ui/viewport/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace blush {
namespace {

constexpr double turn_per_height = 3.2;   // radians for a drag over the image's height
constexpr double closer_per_notch = 0.88; // factor of the distance per notch of the wheel
constexpr double stops_per_height = 8;
constexpr float stops_per_notch = 0.25f;
constexpr double same_wheeling = 1; // maximum seconds between notches of one gesture
constexpr double speed = 0.8;       // pivot distances per second

// Movement along right, up and forward, from W A S D Q E.
Vec3d wanted_motion() {
    const auto axis = [](int plus, int minus) { return double(ImGui::IsKeyDown(plus)) - double(ImGui::IsKeyDown(minus)); };
    return {axis('D', 'A'), axis('E', 'Q'), axis('W', 'S')};
}

} // namespace

void Navigation::press() {
    const ImGuiIO& io = ImGui::GetIO();
    const auto start = [&](int button, Mode mode, bool may_click) {
        button_ = button;
        mode_ = mode;
        may_click_ = may_click;
        moved_ = false;
        last_ = {io.MousePos.x, io.MousePos.y};
    };
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && ImGui::IsKeyDown('E'))
        start(0, Mode::expose, false);
    else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && io.KeyCtrl)
        start(0, io.KeyShift ? Mode::turn_surroundings : Mode::shift, !io.KeyShift);
    else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left))
        start(0, io.KeyShift ? Mode::pan : Mode::orbit, io.KeyShift || !io.KeyAlt);
    else if (ImGui::IsMouseClicked(ImGuiMouseButton_Right))
        start(1, io.KeyAlt ? Mode::dolly : Mode::look, !io.KeyAlt);
    else if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle))
        start(2, io.KeyShift || io.KeyAlt ? Mode::pan : Mode::orbit, false);
}

void Navigation::drag(NavigationResult& result, const View& view, const ImageRect& image) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    moved_ |= ImGui::IsMouseDragging(button_, may_click_ ? -1.f : 0.f);
    if (moved_) {
        const double dx = double(mouse.x - last_.x) / image.height, dy = double(mouse.y - last_.y) / image.height;
        last_ = {mouse.x, mouse.y};
        if (dx != 0 || dy != 0) {
            switch (mode_) {
            case Mode::orbit: result.view = orbit(view, -dx * turn_per_height, dy * turn_per_height); break;
            case Mode::pan: result.view = pan(view, dx, dy); break;
            case Mode::dolly: result.view = dolly(view, std::exp2(2 * (dy - dx))); break;
            case Mode::look: result.view = look_around(view, -dx * turn_per_height / 2, -dy * turn_per_height / 2); break;
            case Mode::expose: result.brighter = float(stops_per_height * (dx - dy)); break;
            case Mode::shift:
                result.shift_x = dx * image.height;
                result.shift_y = dy * image.height;
                break;
            case Mode::turn_surroundings: result.turned = dx; break;
            case Mode::none: break;
            }
        }
    }
    const Vec3d motion = wanted_motion();
    if (mode_ == Mode::look && (motion.x != 0 || motion.y != 0 || motion.z != 0)) {
        const double seconds = std::min(ImGui::GetIO().DeltaTime, 0.1f);
        const double step = speed * seconds * view.pivot_distance * (ImGui::GetIO().KeyShift ? 4 : 1);
        result.view = fly(result.view.value_or(view), {motion.x * step, motion.y * step, motion.z * step});
        result.flying = moved_ = true;
    }
}

void Navigation::release(NavigationResult& result) {
    if (!moved_ && may_click_) {
        if (button_ == ImGuiMouseButton_Right)
            result.inspect = last_;
        else if (ImGui::GetIO().KeyCtrl)
            result.focus = last_;
        else if (ImGui::GetIO().KeyShift)
            (ImGui::GetIO().KeyAlt ? result.toggle_shadow : result.toggle) = last_;
        else
            result.select = last_;
    }
    mode_ = Mode::none;
}

void Navigation::wheel(NavigationResult& result, const View& view) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyCtrl) {
        result.zoom = std::exp2(io.MouseWheel / 2);
        return;
    }
    if (!io.KeyAlt) {
        result.view = dolly(result.view.value_or(view), std::pow(closer_per_notch, io.MouseWheel));
        return;
    }
    result.brighter += stops_per_notch * io.MouseWheel;
    result.begins_exposure |= ImGui::GetTime() - exposed_at_ > same_wheeling;
    exposed_at_ = ImGui::GetTime();
}

NavigationResult Navigation::update(const View& view, const ImageRect& image, bool hovered, bool free) {
    NavigationResult result;
    if (mode_ == Mode::none && hovered && free) {
        press();
        result.begins_exposure = mode_ == Mode::expose;
    }
    if (mode_ != Mode::none) {
        drag(result, view, image);
        if (!ImGui::IsMouseDown(button_)) release(result);
    }
    if (ImGui::GetIO().MouseWheel != 0 && hovered) wheel(result, view);
    return result;
}

} // namespace blush
