// Health panel: dropped samples by cause and place, fireflies, and the light removed by clamping. Each listed sample can be
// replayed.
#include "ui/panels/panels.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <fmt/format.h>

namespace blush {
namespace {

void cell(const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.c_str());
}

// Traces the sample again in the background; compiles the scene for it.
void replay(PanelContext& c, int x, int y, int64_t sample, uint32_t seed) {
    RenderSettings settings = c.project().render;
    settings.width = c.render_width;
    settings.height = c.render_height;
    settings.resolution_scale = 1;
    settings.seed = seed;
    HealthView& view = c.ui.health;
    view.log.clear();
    view.replay = std::make_shared<BackgroundJob<std::string>>(
        "Tracing a sample",
        [scene = c.scene(), settings, x, y, sample](JobProgress&) { return trace_sample(scene, settings, x, y, sample); }, [] {});
}

// Table cells for (pixel, sample, seed) and the Replay button. Disabled for coarse frames: their samples do not exist at full
// size.
void sample_cells(PanelContext& c, const char* list, size_t i, int x, int y, int64_t sample, uint32_t seed) {
    cell(fmt::format("{}, {}", x, y));
    cell(fmt::format("{}", sample));
    ImGui::TableNextColumn();
    ImGui::PushID(list);
    ImGui::PushID(int(i));
    ImGui::BeginDisabled(c.frame->divider != 1 || c.ui.health.replay);
    if (ImGui::SmallButton("Replay")) replay(c, x, y, sample, seed);
    if (i == 0) c.ui.probe.record_last_item(fmt::format("Health/Replay {}", list));
    ImGui::EndDisabled();
    ImGui::PopID();
    ImGui::PopID();
}

bool begin_list(const char* name, std::initializer_list<const char*> columns) {
    const float height = ImGui::GetTextLineHeightWithSpacing() * 7;
    if (!ImGui::BeginTable(name, int(columns.size()), ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp, {0, height}))
        return false;
    ImGui::TableSetupScrollFreeze(0, 1);
    for (const char* column : columns) ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    return true;
}

void draw_faults(const Health& health) {
    if (!ImGui::BeginTable("faults", 3, ImGuiTableFlags_SizingStretchProp)) return;
    for (const char* column : {"Cause", "Place", "Samples"}) ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    for (int kind = 0; kind < Fault::kinds; ++kind)
        for (int place = 0; place < Fault::places; ++place)
            if (const int64_t count = health.count(Fault::Kind(kind), Fault::Place(place)); count > 0) {
                cell(std::string(to_string(Fault::Kind(kind))));
                cell(std::string(to_string(Fault::Place(place))));
                cell(fmt::format("{}", count));
            }
    ImGui::EndTable();
}

void draw_dropped(PanelContext& c, const Health& health) {
    if (health.truncated > 0)
        quiet_text(fmt::format("{} paths were truncated at the maximum path length; this darkens the image.", health.truncated));
    if (health.dropped() == 0) return quiet_text("No invalid samples: no radiance was NaN, infinite or negative.");
    quiet_text(fmt::format("{} samples dropped: {} NaN, {} infinite, {} negative. Each pixel is the mean of its valid samples.",
                           health.dropped(), health.nan, health.infinite, health.negative));
    draw_faults(health);
    Fields f(c.ui, "Health");
    f.checkbox("Show map", c.ui.health.map, "Show in the viewport where samples were dropped.");
    if (!begin_list("first", {"Cause", "Place", "Vertex", "Pixel", "Sample", ""})) return;
    for (size_t i = 0; i < health.first.size(); ++i) {
        const BadSample& s = health.first[i];
        cell(std::string(to_string(s.fault.kind)));
        cell(std::string(to_string(s.fault.place)));
        cell(fmt::format("{}", s.fault.vertex));
        sample_cells(c, "dropped", i, s.x, s.y, s.sample, s.seed);
    }
    ImGui::EndTable();
}

void draw_fireflies(PanelContext& c, const Health& health) {
    if (health.fireflies.empty()) return quiet_text("No sample is more than twice the mean of its pixel.");
    if (!begin_list("fireflies", {"x mean", "Nits", "Pixel", "Sample", ""})) return;
    for (size_t i = 0; i < health.fireflies.size(); ++i) {
        const Firefly& s = health.fireflies[i];
        cell(fmt::format("{:.1f}", s.excess));
        cell(fmt::format("{:.4g}", s.luminance));
        sample_cells(c, "firefly", i, s.x, s.y, s.sample, s.seed);
    }
    ImGui::EndTable();
}

void draw_clamping(PanelContext& c) {
    RenderSettings r = c.project().render;
    Fields f(c.ui, "Health");
    bool on = r.clamp.limit > 0;
    if (f.checkbox("Clamp", on, "Limit the radiance of bright samples. It hides fireflies but is biased: the image gets too dark."))
        r.clamp.limit = on ? 10.f : 0.f;
    if (on) {
        f.number(
            "Limit", r.clamp.limit,
            {.min = 1e-3f, .max = 1e6f, .reset = 10, .unit = "nits", .tip = "Maximum component of a sample. Its hue does not change."});
        f.checkbox("All light", r.clamp.all, "Clamp all light. Otherwise only indirect light is clamped.");
    }
    if (f.changed()) c.apply(SetRender{r}, f.gesture());
    if (!on) return quiet_text("Off: the image is not changed.");
    const ClampReport& report = c.frame->clamp;
    quiet_text(fmt::format("Biased: removes {:.3g} % of the light, from {} samples.", 100 * report.share, report.samples));
}

void draw_replay(PanelContext& c) {
    HealthView& view = c.ui.health;
    if (view.replay) {
        if (auto log = view.replay->take()) {
            view.log = *std::move(log);
            view.replay.reset();
        } else {
            quiet_text("Tracing the sample again");
            c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, 0.1);
        }
    }
    if (view.log.empty()) return;
    if (!section(c.ui, "Replay")) return;
    ImGui::BeginChild("log", {0, ImGui::GetTextLineHeightWithSpacing() * 14}, true, ImGuiWindowFlags_HorizontalScrollbar);
    ImGui::TextUnformatted(view.log.c_str());
    ImGui::EndChild();
}

} // namespace

void draw_health_panel(PanelContext& c) {
    if (!c.frame) return quiet_text("Waiting for the first render.");
    if (section(c.ui, "Dropped samples")) draw_dropped(c, c.frame->health);
    if (section(c.ui, "Fireflies")) draw_fireflies(c, c.frame->health);
    if (section(c.ui, "Clamping")) draw_clamping(c);
    draw_replay(c);
}

} // namespace blush
