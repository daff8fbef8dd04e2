// Timeline: the animation clip and the time. A row below the image, for scenes with animations.
#include "ui/gl/icons.h"
#include "ui/panels/panels.h"
#include "ui/widgets/guide_mark.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

constexpr double frames_per_second = 24;

void stop(PanelContext& c) { c.ui.time = {}; }

void set_scene_selection(PanelContext& c, const SceneSelection& scene_selection, Gesture gesture = no_gesture) {
    if (scene_selection != c.scene().scene_selection) c.apply(SetSceneSelection{scene_selection}, gesture);
}

void draw_clips(PanelContext& c) {
    const Clip* chosen = c.scene().clips.find(c.scene().scene_selection.clip);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 10);
    const bool open = ImGui::BeginCombo("##clip", chosen ? chosen->name.c_str() : "Rest pose");
    c.ui.probe.record_last_item("Time/Animation");
    if (!open) {
        tip_for_last_item(c.ui, "Animation clip of the file, or the rest pose.");
        return;
    }
    SceneSelection scene_selection = c.scene().scene_selection;
    const auto item = [&](Id<Clip> id, const std::string& name) {
        ImGui::PushID(int(id.value));
        const bool picked = ImGui::Selectable(name.c_str(), id == c.scene().scene_selection.clip);
        ImGui::PopID();
        c.ui.probe.record_last_item("Time/Animation/" + name);
        if (picked && id != scene_selection.clip) {
            scene_selection.clip = id;
            scene_selection.seconds = 0;
        }
    };
    item({}, "Rest pose");
    for (const auto& [id, clip] : c.scene().clips) item(id, clip.name);
    ImGui::EndCombo();
    if (scene_selection != c.scene().scene_selection) stop(c);
    set_scene_selection(c, scene_selection);
}

void draw_play(PanelContext& c) {
    TimeView& time = c.ui.time;
    if (icon_button("play", time.playing ? Icon::pause : Icon::play, tone::text)) {
        const bool play = !time.playing;
        stop(c);
        if (play) time = {.playing = true, .gesture = c.ui.gestures.begin()};
        c.ui.gestures.end();
    }
    c.ui.probe.record_last_item("Time/Play");
    tip_for_last_item(c.ui, time.playing ? "Pause" : "Loop playback. Each frame is rendered for as long as the frame rate allows.");
}

void draw_slider(PanelContext& c, const Clip& clip) {
    TimeView& time = c.ui.time;
    SceneSelection scene_selection = c.scene().scene_selection;
    const std::string length = fmt::format("/ {:.2f} s", clip.seconds);
    const float padding = ImGui::GetStyle().WindowPadding.x; // the mark is at the edge, and its gap is as wide as the slider's
    ImGui::SetNextItemWidth(padding - guide_mark_width() - ImGui::CalcTextSize(length.c_str()).x - 2 * ImGui::GetStyle().ItemSpacing.x);
    const bool moved = ImGui::SliderFloat("##time", &scene_selection.seconds, 0, clip.seconds, "%.2f s", ImGuiSliderFlags_AlwaysClamp);
    c.ui.probe.record_last_item("Time/Time");
    if (ImGui::IsItemActivated()) time = {.gesture = c.ui.gestures.begin(), .dragged = true};
    if (moved) set_scene_selection(c, scene_selection, time.gesture);
    if (time.dragged && !ImGui::IsItemActive()) {
        time = {};
        c.ui.gestures.end();
    }
    if (!time.dragged) tip_for_last_item(c.ui, "Time of the animation in seconds. A drag is one undo step.");
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    quiet_text(length);
}

// Advances the time while playing, and requests the next frame.
void play(PanelContext& c, const Clip& clip) {
    if (!c.ui.time.playing) return;
    SceneSelection scene_selection = c.scene().scene_selection;
    scene_selection.seconds = clip.seconds > 0 ? std::fmod(scene_selection.seconds + ImGui::GetIO().DeltaTime, clip.seconds) : 0;
    set_scene_selection(c, scene_selection, c.ui.time.gesture);
    c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, 1 / frames_per_second);
}

} // namespace

void draw_time(PanelContext& c) {
    const ImVec2 begin = ImGui::GetCursorPos();
    ImGui::SetCursorPosX(ImGui::GetWindowWidth() - guide_mark_width());
    guide_mark(c.ui, "Guide/Timeline", guide_page::timeline, ImGui::GetFrameHeight());
    ImGui::SetCursorPos(begin);
    ImGui::AlignTextToFramePadding();
    draw_clips(c);
    const Clip* found = c.scene().clips.find(c.scene().scene_selection.clip);
    if (!found) return stop(c);
    const Clip clip = *found; // a copy: edits may replace the table
    play(c, clip);
    ImGui::SameLine();
    draw_play(c);
    ImGui::SameLine();
    draw_slider(c, clip);
}

} // namespace blush
