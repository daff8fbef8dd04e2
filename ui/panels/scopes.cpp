// Scopes: histogram and waveform of scene-linear values, in stops from middle grey, and of displayed values.
#include "ui/panels/panels.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

constexpr ImU32 channel_tones[] = {IM_COL32(226, 82, 74, 110), IM_COL32(98, 190, 86, 110), IM_COL32(86, 136, 240, 110)};
constexpr ImU32 luma_tone = IM_COL32(220, 220, 220, 200), ground = IM_COL32(22, 22, 22, 255), grid = IM_COL32(52, 52, 52, 255);

struct Box {
    ImVec2 low, high;
    float width() const { return high.x - low.x; }
    float height() const { return high.y - low.y; }
};

// Values that get a grid line and a label.
struct Marks {
    float first, step;
    const char* format;
};
Marks marks_of(const ScopeAxis& axis) { return axis.stops ? Marks{-6, 3, "{:+.0f}"} : Marks{0, 0.25f, "{:.2g}"}; }

std::string mark_text(const ScopeAxis& axis, float value) {
    if (axis.stops && value == 0) return "grey";
    return fmt::format(fmt::runtime(marks_of(axis).format), value);
}

// Grid lines for values of the x axis or the y axis.
void draw_marks(ImDrawList& draw, const Box& box, const ScopeAxis& axis, bool upright) {
    const Marks marks = marks_of(axis);
    const float em = ImGui::GetFontSize();
    float last_top = box.high.y + em;
    for (float value = marks.first; value <= axis.high; value += marks.step) {
        const float t = (value - axis.low) / (axis.high - axis.low);
        const std::string text = mark_text(axis, value);
        if (upright) {
            const float x = std::round(box.low.x + t * (box.width() - 1));
            draw.AddLine({x, box.low.y}, {x, box.high.y}, grid);
            const float width = ImGui::CalcTextSize(text.c_str()).x;
            draw.AddText({std::clamp(x - width / 2, box.low.x, box.high.x - width), box.high.y + em * 0.1f}, tone::dim_text, text.c_str());
        } else {
            const float y = std::round(box.high.y - 1 - t * (box.height() - 1));
            draw.AddLine({box.low.x, y}, {box.high.x, y}, grid);
            const float top = std::clamp(y - em * 1.05f, box.low.y, box.high.y - em);
            if (last_top - top < em) continue; // no room between the lines for a label at each
            last_top = top;
            draw.AddText({box.low.x + em * 0.2f, top}, tone::dim_text, text.c_str());
        }
    }
}

// Bars have the square root of the counts, so that small counts are visible beside large ones.
void draw_histogram(ImDrawList& draw, const Box& box, const Histogram& h) {
    uint32_t most = 1;
    for (const auto& counts : h.counts) most = std::max(most, *std::max_element(counts.begin(), counts.end()));
    const auto height = [&](uint32_t count) { return box.height() * 0.96f * std::sqrt(float(count) / float(most)); };
    const float step = box.width() / float(h.bins);
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < h.bins; ++i) {
            const uint32_t count = h.counts[size_t(k)][size_t(i)];
            if (count == 0) continue;
            const float x = box.low.x + step * float(i);
            draw.AddRectFilled({x, box.high.y - height(count)}, {x + step, box.high.y}, channel_tones[k]);
        }
    }
    for (int i = 0; i < h.bins; ++i) {
        const float x = box.low.x + step * (float(i) + 0.5f);
        draw.PathLineTo({x, box.high.y - height(h.counts[3][size_t(i)])});
    }
    draw.PathStroke(luma_tone, 0, 1);
}

std::string share(int64_t count, int64_t all) { return all > 0 ? fmt::format("{:.2g} %", 100 * double(count) / double(all)) : ""; }

std::string ends_text(const Histogram& h) {
    const int64_t below = h.below[3], above = h.above[3], clipped = h.axis.stops ? above : above + int64_t(h.counts[3].back());
    if (h.axis.stops) return fmt::format("black or below: {}", share(below, h.pixels));
    return fmt::format("at black: {}, at white: {}", share(below + int64_t(h.counts[3].front()), h.pixels), share(clipped, h.pixels));
}

Box plot_box(float width, float height) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy({width, height + ImGui::GetFontSize() * 1.2f});
    const Box box{at, {at.x + width, at.y + height}};
    ImGui::GetWindowDrawList()->AddRectFilled(box.low, box.high, ground);
    return box;
}

void draw_column(PanelContext& c, const char* title, const char* tip, const Histogram& h, const ScopeAxis& axis, ImTextureID waveform,
                 float height, bool flat) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float gap = ImGui::GetFontSize() * 0.6f, all = std::floor(ImGui::GetContentRegionAvail().x);
    const float width = flat ? std::floor((all - gap) / 2) : all;
    ImGui::PushFont(heading_font());
    ImGui::TextUnformatted(title);
    ImGui::PopFont();
    tip_for_last_item(c.ui, tip);
    const Box histogram_box = plot_box(width, height);
    c.ui.probe.record_last_item(std::string("Scopes/") + title);
    if (flat) ImGui::SameLine(0, gap);
    const Box wave_box = plot_box(width, height);
    const float label_room = ImGui::CalcTextSize("grey ").x; // at the left, where a waveform would cover the labels
    if (h.pixels == 0) return;
    draw_marks(draw, histogram_box, h.axis, true);
    draw_histogram(draw, histogram_box, h);
    draw_marks(draw, wave_box, axis, false);
    if (waveform) draw.AddImage(waveform, {wave_box.low.x + label_room, wave_box.low.y}, wave_box.high);
    quiet_text(ends_text(h));
}

} // namespace

void draw_scopes_panel(PanelContext& c) {
    ScopesView& view = c.ui.scopes;
    const float em = ImGui::GetFontSize();
    const uint64_t before = view.scopes.number();
    const bool pending = c.has_image() && view.scopes.update(c.shown_image(), scopes_of);
    // The waveforms of a new result become textures at the start of the next frame.
    if (pending || view.scopes.number() != before) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, 0.05);
    static const Scopes nothing;
    const Scopes& scopes = view.scopes.output() ? *view.scopes.output() : nothing;
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const bool flat = room.x > 2.5f * room.y; // all four side by side
    const float labels = (scopes.step > 1 ? 1.4f : 0) * em;
    const float height = std::max(4 * em, std::floor(flat ? room.y - 4.8f * em - labels : (room.y - 6.2f * em - labels) / 2));
    if (ImGui::BeginTable("scopes", 2)) {
        ImGui::TableNextColumn();
        draw_column(c, "Light", "Scene-linear, in stops from middle grey. View settings have no effect.", scopes.scene,
                    scopes.scene_wave.axis, c.waveforms.scene, height, flat);
        ImGui::TableNextColumn();
        draw_column(c, "Displayed", "Displayed values: after exposure, white balance, look, view transform and gamma.", scopes.displayed,
                    scopes.displayed_wave.axis, c.waveforms.displayed, height, flat);
        ImGui::EndTable();
    }
    if (scopes.step > 1) quiet_text(fmt::format("Every {}th pixel is read.", scopes.step * scopes.step));
}

} // namespace blush
