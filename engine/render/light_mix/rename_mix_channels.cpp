#include "render/light_mix/rename_mix_channels.h"

#include "core/math.h"
#include "render/light_mix/light_groups.h"
#include "render/materials/material_table.h"

#include <algorithm>
#include <limits>

namespace blush {
namespace {

// True if nothing changed that groups are made from or named after. Runs at every step of a drag.
bool same_groups(const Scene& before, const Scene& after) {
    const auto same = [](const auto& a, const auto& b, const auto& same_record) {
        return std::ranges::all_of(std::decay_t<decltype(a)>::changed(a, b), [&](auto id) {
            const auto *x = a.find(id), *y = b.find(id);
            return x && y && same_record(*x, *y);
        });
    };
    const auto is_emissive = [](const Material& m) { return m.unlit || (m.emits && !is_black(emission_of(m))); };
    return before.meshes.shares_storage(after.meshes) && before.environment.group == after.environment.group &&
           before.environment.kind == after.environment.kind &&
           same(before.nodes, after.nodes,
                [](const Node& a, const Node& b) {
                    return a.name == b.name && a.parent == b.parent && a.visible == b.visible && a.mesh == b.mesh && a.light == b.light;
                }) &&
           same(before.lights, after.lights, [](const Light& a, const Light& b) { return a.name == b.name && a.group == b.group; }) &&
           same(before.materials, after.materials,
                [&](const Material& a, const Material& b) { return a.name == b.name && is_emissive(a) == is_emissive(b); });
}

LightGroups all_groups(const Scene& scene) { return make_light_groups(scene, std::numeric_limits<int>::max()); }

// New name of group `index`: unchanged if one of its members still has a group of that name, else the name of the group that its
// members are in now. Empty: the group is gone.
std::string name_now(const LightGroups& was, int index, const LightGroups& is) {
    const std::string& before = was.groups[size_t(index)].name;
    std::string name;
    const auto meet = [&](int group) {
        const std::string& now = is.groups[size_t(group)].name;
        if (name.empty() || now == before) name = now;
    };
    const auto meet_all = [&](const auto& places, const auto& now) {
        for (const auto& [id, group] : places)
            if (const auto it = now.find(id); group == index && it != now.end()) meet(it->second);
    };
    const auto environment = std::ranges::find(is.groups, true, &LightGroup::environment);
    if (was.groups[size_t(index)].environment && environment != is.groups.end()) meet(is.environment);
    meet_all(was.light_nodes, is.light_nodes);
    meet_all(was.surface_nodes, is.surface_nodes);
    meet_all(was.surface_materials, is.surface_materials);
    return name;
}

bool has_channel(const LightMix& mix, const std::string& group) {
    return std::ranges::find(mix.channels, group, &MixChannel::group) != mix.channels.end();
}
bool has_group(const LightGroups& groups, const std::string& name) {
    return std::ranges::find(groups.groups, name, &LightGroup::name) != groups.groups.end();
}

} // namespace

std::optional<LightMix> rename_mix_channels(const Project& before, std::span<const Edit> edits) {
    const LightMix& mix = before.scene.mix;
    if (mix.channels.empty() || mix.grouping == LightMix::Grouping::none) return std::nullopt;
    Project after = before;
    for (const Edit& edit : edits) {
        Result<Project> next = blush::apply(after, edit);
        if (!next) return std::nullopt;
        after = *std::move(next);
    }
    if (after.scene.mix != mix || same_groups(before.scene, after.scene)) return std::nullopt;

    const LightGroups was = all_groups(before.scene), is = all_groups(after.scene);
    LightMix carried{mix.grouping, {}};
    std::vector<MixChannel> left; // channels of groups that do not exist now (hidden or deleted)
    for (MixChannel channel : mix.channels) {
        const auto group = std::ranges::find(was.groups, channel.group, &LightGroup::name);
        const std::string now = group == was.groups.end() ? "" : name_now(was, int(group - was.groups.begin()), is);
        if (now.empty()) {
            left.push_back(std::move(channel));
            continue;
        }
        channel.group = now;
        if (!has_channel(carried, now)) carried.channels.push_back(std::move(channel));
    }
    for (MixChannel& channel : left)
        if (!has_group(is, channel.group) && !has_channel(carried, channel.group)) carried.channels.push_back(std::move(channel));
    if (carried == mix) return std::nullopt;
    return carried;
}

} // namespace blush
