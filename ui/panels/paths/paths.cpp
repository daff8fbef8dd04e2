// Paths panel: the paths of a pixel, one by one as arithmetic and together as the mean that the film holds.
#include "scene/changes.h"
#include "ui/panels/panels.h"
#include "ui/panels/paths/sections.h"
#include "ui/viewport/path_lines.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

std::string place_text(const PathsView& view) {
    const std::vector<TracedPixel>& pixels = view.request->pixels;
    const PathSet* set = view.set();
    const size_t count = set ? set->paths.size() : 0;
    if (pixels.size() == 1) return fmt::format("Pixel {}, {}: {} paths", pixels[0].x, pixels[0].y, count);
    return fmt::format("{} pixels of a rectangle: {} paths", pixels.size(), count);
}

bool scene_has_changed(const PanelContext& c) {
    const PathWork::Input& at = *c.ui.paths.request;
    RenderSettings settings = c.project().render;
    settings.width = at.settings.width;
    settings.height = at.settings.height;
    const Changes changes = diff(at.scene, at.settings, c.scene(), settings);
    return changes.affects_image() && !changes.only_view();
}

void draw_heading(PanelContext& c) {
    PathsView& view = c.ui.paths;
    if (ImGui::Button("Pick a pixel")) c.ui.tool = ViewTool::paths;
    c.ui.probe.record_last_item("Paths/Pick a pixel");
    tip_for_last_item(c.ui, "Then click in the image, or drag a rectangle, of which up to 64 pixels are traced.");
    if (!view.request) return quiet_text("The paths of a pixel appear as lines in the scene, and here as arithmetic.");
    const std::string text = place_text(view);
    same_line_if_fits(ImGui::CalcTextSize(text.c_str()).x, ImGui::GetFontSize());
    ImGui::AlignTextToFramePadding();
    elided_text(c.ui, text, tone::text);
    c.ui.probe.record_last_item("Paths/Place");
    if (!view.state.failure.empty()) quiet_text(view.state.failure);
    if (!scene_has_changed(c)) return;
    quiet_text("The scene has changed since the click.");
    if (ImGui::Button("Trace again")) trace_paths_of(c, view.region);
    c.ui.probe.record_last_item("Paths/Trace again");
}

void draw_player(PanelContext& c, const PathSet& set) {
    PathsView& view = c.ui.paths;
    Fields f(c.ui, "Paths");
    const RecordedPath& path = *view.shown();
    const int64_t last = int64_t(set.paths.size()) - 1;
    view.path = std::clamp<int64_t>(view.path, 0, last);
    bool moved = f.integer("Path", view.path, 0, last, 0, "Drag to scrub through the samples of the pixel, in their order.");
    moved |= f.integer("Vertices", view.steps, 0, int64_t(path.vertices.size()), 0,
                       "How many vertices are shown, to step bounce by bounce. 0: all.");
    if (moved) view.playing = false;
    if (f.button(view.playing ? "Stop" : "Play", "Walks along the paths, vertex by vertex.")) {
        view.playing = !view.playing;
        view.step_due = ImGui::GetTime();
        if (!view.playing) view.steps = 0;
    }
    f.number("Speed", view.speed, {.min = 0.5f, .max = 60, .reset = 4, .unit = "vertices/s", .tip = "Of the playback.", .format = "%.1f"});
    f.integer("Samples", view.samples, 1, PathsView::most_samples, PathsView::default_samples, "Of each pixel. More of them take longer.");
    int channel = int(view.channel);
    if (f.choice("Channel", channel, PathsView::channels,
                 "The channel of the arithmetic. Brightest: that in which the path gives most light."))
        view.channel = PathsView::ShownChannel(channel);
    f.checkbox("Other paths", view.others, "Shows up to 200 paths beside the current one, as thin lines.");
}

} // namespace

void draw_paths_panel(PanelContext& c) {
    draw_heading(c);
    const PathSet* set = c.ui.paths.set();
    if (!c.ui.paths.request || !c.ui.paths.shown()) return;
    draw_player(c, *set);
    if (section(c.ui, "Arithmetic"))
        if (const RecordedPath* path = c.ui.paths.shown()) draw_path_arithmetic(c, *path);
    if (section(c.ui, "Average")) draw_path_average(c, *set);
}

} // namespace blush
