// Light mix panel: a gain per light group, applied to the existing samples.
#include "render/light_mix/bake_mix.h"
#include "render/light_mix/light_mix.h"
#include "ui/panels/panels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

constexpr const char* groupings[] = {"Off", "By light", "By object", "By material", "Manual"};

const MixChannel* find_channel(const LightMix& mix, const std::string& group) {
    const auto it = std::ranges::find(mix.channels, group, &MixChannel::group);
    return it == mix.channels.end() ? nullptr : &*it;
}

MixChannel channel_of(const LightMix& mix, const std::string& group) {
    const MixChannel* channel = find_channel(mix, group);
    return channel ? *channel : MixChannel{.group = group};
}

void set_channel(LightMix& mix, const MixChannel& channel) {
    const auto it = std::ranges::find(mix.channels, channel.group, &MixChannel::group);
    if (it == mix.channels.end())
        mix.channels.push_back(channel);
    else
        *it = channel;
}

// Solos this group; if it is already solo, all groups are enabled again.
LightMix with_solo(LightMix mix, const std::vector<std::string>& groups, const std::string& solo) {
    const bool alone = std::ranges::all_of(groups, [&](const std::string& g) { return channel_of(mix, g).enabled == (g == solo); });
    for (const std::string& group : groups) {
        MixChannel channel = channel_of(mix, group);
        channel.enabled = alone || group == solo;
        if (channel != MixChannel{.group = group} || find_channel(mix, group)) set_channel(mix, channel);
    }
    return mix;
}

void draw_grouping(PanelContext& c) {
    Fields f(c.ui, "Light mix");
    LightMix mix = c.scene().mix;
    int grouping = int(mix.grouping);
    if (f.choice("Groups", grouping, groupings,
                 "Which lights share a gain. Manual: by the group of each light; emissive surfaces by the name of their material.")) {
        mix.grouping = LightMix::Grouping(grouping);
        c.ui.light_mix.disabled_by_user = mix.grouping == LightMix::Grouping::none;
        c.apply(SetMix{mix});
    }
}

// On, solo, name, and the group's share of energy and noise.
void draw_heading(PanelContext& c, const GroupReport& report, LightMix& mix, bool& changed) {
    const std::string& group = report.name;
    MixChannel channel = channel_of(mix, group);
    if (ImGui::Checkbox("##on", &channel.enabled)) {
        set_channel(mix, channel);
        changed = true;
    }
    c.ui.probe.record_last_item("Light mix/" + group + "/On");
    tip_for_last_item(c.ui, "If off, the image is shown without this light. Lamps stay visible as objects.");
    ImGui::SameLine();
    if (ImGui::Button("S")) {
        mix = with_solo(mix, c.mixing->names, group);
        changed = true;
    }
    c.ui.probe.record_last_item("Light mix/" + group + "/Solo");
    tip_for_last_item(c.ui, "Solo: only this group. Click again for all groups.");
    ImGui::SameLine();
    const float em = ImGui::GetFontSize();
    const bool narrow = ImGui::GetContentRegionAvail().x < 16 * em; // the tooltip also has the noise
    const std::string light = fmt::format("{:.1f} % light", 100 * report.energy);
    const std::string noise = report.noise ? fmt::format("{:.1f} % noise", 100 * *report.noise) : "noise not known yet";
    const std::string figures = narrow || !report.noise ? light : light + "  " + noise;
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(figures.c_str()).x - em;
    bool unfolded = c.ui.light_mix.unfolded == group;
    ImGui::AlignTextToFramePadding();
    const std::string shown = elided(group, std::max(em * 4, room));
    if (ImGui::Selectable((shown + "##name").c_str(), unfolded, 0, {std::max(em * 4, room), 0}))
        c.ui.light_mix.unfolded = unfolded ? "" : group;
    c.ui.probe.record_last_item("Light mix/" + group);
    tip_for_last_item(c.ui, (shown == group ? std::string() : group + "\n").append("Click to show its colour settings.").c_str());
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, tone::dim_text);
    ImGui::TextUnformatted(figures.c_str());
    ImGui::PopStyleColor();
    const std::string tip = light + ", " + noise + ": share of the image's luminance and of its noise variance, in this mix.";
    tip_for_last_item(c.ui, tip.c_str());
}

void draw_colour(Fields& f, MixChannel& channel) {
    float stops = channel.intensity > 0 ? std::log2(channel.intensity) : -20;
    if (f.number("Stops", stops,
                 {.min = -20, .max = 20, .reset = 0, .unit = "EV", .step = 0.02f, .tip = "The same gain in stops.", .format = "%+.2f"}))
        channel.intensity = std::exp2(stops);
    f.checkbox("Temperature", channel.use_temperature, "Multiply by the colour of a black body. The luminance does not change.");
    if (channel.use_temperature)
        f.number("Kelvin", channel.kelvin,
                 {.min = 1000,
                  .max = 15000,
                  .reset = 6500,
                  .unit = "K",
                  .bar = true,
                  .tip = "Temperature of the black body.",
                  .format = "%.0f"});
    f.color("Colour", channel.color, {1, 1, 1}, "Linear RGB factor of the group's light, like a colour gel in front of all its lamps.");
}

void draw_group(PanelContext& c, const GroupReport& report) {
    ImGui::PushID(report.name.c_str());
    LightMix mix = c.scene().mix;
    bool changed = false;
    draw_heading(c, report, mix, changed);
    if (changed) c.apply(SetMix{mix});
    const std::string scope = "Light mix/" + report.name;
    Fields f(c.ui, scope.c_str());
    MixChannel channel = channel_of(c.scene().mix, report.name);
    f.number("Intensity", channel.intensity,
             {.min = 0, .max = 1e6f, .reset = 1, .unit = "×", .step = 0.01f, .tip = "Gain of the group.", .format = "%.3g"});
    if (c.ui.light_mix.unfolded == report.name) draw_colour(f, channel);
    if (f.changed()) {
        mix = c.scene().mix;
        set_channel(mix, channel);
        c.apply(SetMix{mix}, f.gesture());
    }
    ImGui::PopID();
}

// Error of the displayed image; until the session has estimated it, the prediction from the groups' variances.
std::string noise_text(const Frame& frame, const Gains& gains) {
    const ErrorEstimate& e = frame.error;
    if (!e.rmse_known) return "Noise of the mix: not known yet.";
    if (frame.gains == gains)
        return fmt::format("Noise of the mix: RMSE {:.3g}, 95 % interval {:.3g} to {:.3g}.", e.rmse, e.rmse_low, e.rmse_high);
    return fmt::format("Noise of the mix: RMSE {:.3g} predicted.", predicted_rmse(frame, gains));
}

std::string memory_text(const Frame& frame) {
    constexpr double film = 2 * sizeof(Vec3d), shown = sizeof(Vec3);
    const double pixels = double(frame.width) * double(frame.height) * 1e-6;
    const double each = pixels * (film + shown);
    return fmt::format("Memory: {:.0f} MB a group in film and frame, {:.0f} MB in all.", each, each * double(frame.groups.size()));
}

void draw_groups(PanelContext& c) {
    const Frame& frame = *c.frame;
    if (const int sharing = frame.light_groups->sharing) {
        quiet_text(fmt::format("More than {} groups: {} of them share the last plane and one gain. Groups with a gain come first.",
                               max_light_groups, sharing));
        c.ui.probe.record_last_item("Light mix/Sharing");
    }
    for (const GroupReport& report : report_groups(frame, c.mixing->names, c.mixing->gains)) draw_group(c, report);
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.4f});
    quiet_text(noise_text(frame, c.mixing->gains));
    quiet_text(memory_text(frame));
}

void draw_bake(PanelContext& c) {
    const bool nothing = c.scene().mix.channels.empty();
    ImGui::BeginDisabled(nothing);
    if (ImGui::Button("Bake", {-FLT_MIN, 0})) c.apply(bake_mix(c.scene()));
    ImGui::EndDisabled();
    c.ui.probe.record_last_item("Light mix/Bake");
    tip_for_last_item(c.ui, "Writes the mix into the lights, materials and environment as one undo step. The image does not change.");
}

} // namespace

void draw_light_mix_panel(PanelContext& c) {
    draw_grouping(c);
    if (c.scene().mix.grouping == LightMix::Grouping::none)
        return quiet_text("With groups, edits of light intensity and colour apply to the existing samples: the render does not restart.");
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.4f});
    // Bake stays visible, however long the list of groups is.
    if (ImGui::BeginChild("groups", {0, -ImGui::GetFrameHeightWithSpacing()})) {
        if (c.mixing)
            draw_groups(c);
        else
            quiet_text("Waiting for a render with these groups.");
    }
    ImGui::EndChild();
    draw_bake(c);
}

} // namespace blush
