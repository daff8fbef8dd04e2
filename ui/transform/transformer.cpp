#include "ui/transform/transformer.h"

#include "scene/affine.h"
#include "ui/viewport/viewport_marks.h"
#include "ui/window/theme.h"

#include <utility>

namespace blush {
namespace {

constexpr ImU32 axis_tones[] = {tone::axis_x, tone::axis_y, tone::axis_z};

// A window above all panels, so that they do not receive the mouse meanwhile.
void cover_window() {
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    if (ImGui::Begin("##transform", nullptr, flags)) {
        if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
        ImGui::InvisibleButton("all", ImGui::GetIO().DisplaySize);
    }
    ImGui::End();
}

Vec3d middle_of(const Scene& scene, std::span<const TransformTarget> targets) {
    Vec3d sum{0, 0, 0};
    for (const TransformTarget& target : targets) sum = sum + handle_point(scene, target.node);
    return sum / double(targets.size());
}

bool changes_nothing(const Motion& m) { return m.by == Vec3d{0, 0, 0} && m.radians == 0 && m.factors == Vec3d{1, 1, 1}; }

} // namespace

void Transformer::begin(PanelContext& c, const TransformRequest& request, const Projection& projection, const ImageRect& image) {
    targets_ = transform_targets(c.scene(), c.ui.selection(c.scene()));
    const std::string problem = c.ui.selected ? why_not(c.scene(), targets_, request.mode) : "Select an object to transform first";
    if (!problem.empty()) {
        c.ui.transform.keys.clear();
        return c.ui.toasts.note(problem);
    }
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    tool_.emplace(TransformStart{.mode = request.mode,
                                 .pivot = middle_of(c.scene(), targets_),
                                 .local_axes = local_axes(c.scene(), c.ui.selected),
                                 .projection = projection,
                                 .image = image,
                                 .mouse = {mouse.x, mouse.y},
                                 .lock = request.lock,
                                 .local_first = c.ui.transform.local,
                                 .ring = request.ring});
    applied_.reset();
    by_drag_ = request.by_drag;
    gesture_ = c.ui.gestures.begin();
    c.ui.placing_by = PlacingBy::hand;
    c.ui.transform.active = true;
}

void Transformer::end(PanelContext& c, bool confirmed) {
    if (!confirmed) c.document.withdraw(gesture_);
    tool_.reset();
    c.ui.gestures.end();
    c.ui.transform.active = false;
    c.ui.transform.keys.clear();
}

void Transformer::cancel(PanelContext& c) {
    c.ui.transform.wanted.reset();
    c.ui.transform.keys.clear();
    if (tool_) end(c, false);
}

std::optional<bool> Transformer::confirmation(PanelContext& c) {
    const ImGuiIO& io = ImGui::GetIO();
    tool_->point_at({io.MousePos.x, io.MousePos.y}, io.KeyShift, io.KeyCtrl);
    for (const KeyPress& press : std::exchange(c.ui.transform.keys, {})) {
        const TransformTool::Answer answer = tool_->press(press);
        if (answer == TransformTool::Answer::confirmed) return true;
        if (answer == TransformTool::Answer::cancelled) return false;
    }
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) return false;
    if (by_drag_ ? !ImGui::IsMouseDown(ImGuiMouseButton_Left) : ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return true;
    return {};
}

// Restarts from the initial transforms: the previous mode has no effect.
void Transformer::apply(PanelContext& c) {
    const Motion motion = tool_->motion();
    if (applied_ == motion) return;
    applied_ = motion;
    c.document.withdraw(gesture_);
    problem_ = why_not(c.scene(), targets_, motion.mode);
    if (changes_nothing(motion) || !problem_.empty()) return;
    const std::vector<Edit> edits = transform_edits(c.scene(), targets_, motion);
    if (!edits.empty()) c.apply(edits, transform_label(c.scene(), targets_, motion.mode), gesture_);
}

void Transformer::draw_axes(ImDrawList& draw, const Projection& projection, const ImageRect& image) const {
    const AxisLock& lock = tool_->lock();
    const std::array<Vec3d, 3> axes = tool_->axes();
    const auto seen = projection.project(tool_->pivot());
    if (!seen) return;
    const double reach = 4 * projection.height_at(seen->distance);
    for (int i = 0; i < 3 && lock.axis >= 0; ++i) {
        if ((i == lock.axis) == lock.plane) continue;
        const Vec3d along = axes[size_t(i)] * reach;
        WorldPen{draw, projection, image, axis_tones[i]}.line(tool_->pivot() - along, tool_->pivot() + along);
    }
    if (tool_->mode() == TransformMode::grab || tool_->is_trackball() || by_drag_) return;
    const ScreenPoint from = image.at(*seen);
    draw.AddLine({from.x, from.y}, ImGui::GetIO().MousePos, tone::dim_text, std::max(1.f, ImGui::GetFontSize() / 14));
}

bool Transformer::update(PanelContext& c, ImDrawList& draw, const Projection& projection, const ImageRect& image) {
    if (const auto wanted = std::exchange(c.ui.transform.wanted, {})) begin(c, *wanted, projection, image);
    if (!tool_) return false;
    cover_window();
    c.ui.wraps_cursor = true;
    const std::optional<bool> confirmed = confirmation(c);
    if (confirmed != false) apply(c);
    if (!confirmed) {
        draw_axes(draw, projection, image);
        const std::string text = problem_.empty() ? tool_->text() : problem_;
        draw_hint(draw, text + (by_drag_ ? "" : "   Enter or click: confirm.  Esc: cancel"));
        c.ui.probe.record("Transforming/" + text, {image.x, image.y, image.width, image.height});
    } else {
        end(c, *confirmed);
    }
    return true;
}

} // namespace blush
