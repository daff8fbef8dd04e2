#include "render/light_mix/light_groups.h"

#include "render/compile/expanded_lights.h"
#include "render/lights/environment_table.h"
#include "render/materials/material_table.h"
#include "scene/changes.h"
#include "scene/lights/color_temperature.h"
#include "scene/lights/light_units.h"
#include "scene/lights/light_visibility.h"
#include "scene/node_name.h"
#include "scene/world_transforms.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <tuple>

namespace blush {
namespace {

using Grouping = LightMix::Grouping;

// Key of a group: the kind of emitter, and its id or the group's manual name.
enum class KeyKind { environment, light, object, material, hand, unlit };
using Key = std::tuple<KeyKind, uint32_t, std::string>;

bool is_emissive(const Material& m) { return m.unlit || !is_black(emission_of(m)); }

// Collects emitters in scene order; emitters with equal keys share a group.
class Grouper {
public:
    Grouper(const Scene& scene, int most) : scene_(scene), by_(scene.mix.grouping), most_(size_t(most)) {}

    LightGroups made() {
        if (scene_.environment.kind != Environment::Kind::none) groups_.environment = add_environment();
        WorldTransforms transforms(scene_);
        for (const auto& [id, node] : scene_.nodes) {
            if (id.value & expanded_id_bit || !transforms(id).visible) continue;
            if (const Light* light = scene_.lights.find(node.light)) add_light(id, node, *light);
            if (const Mesh* mesh = scene_.meshes.find(node.mesh)) add_surfaces(id, node, *mesh);
        }
        make_names_unique();
        share_last_plane();
        groups_.base = scene_;
        return std::move(groups_);
    }

private:
    int index_of(const Key& key, const std::string& name) {
        const auto [it, is_new] = known_.try_emplace(key, int(groups_.groups.size()));
        if (is_new) groups_.groups.push_back({.name = name});
        return it->second;
    }

    int add_environment() {
        const std::string& by_hand = scene_.environment.group;
        const bool named_by_hand = by_ == Grouping::by_hand && !by_hand.empty();
        const int group =
            named_by_hand ? index_of({KeyKind::hand, 0, by_hand}, by_hand) : index_of({KeyKind::environment, 0, {}}, "Environment");
        groups_.groups[size_t(group)].environment = true;
        return group;
    }

    void add_light(Id<Node> id, const Node& node, const Light& light) {
        int group = 0;
        if (by_ == Grouping::by_object)
            group = index_of({KeyKind::object, id.value, {}}, node_name(scene_, id, node));
        else if (by_ == Grouping::by_hand && !light.group.empty())
            group = index_of({KeyKind::hand, 0, light.group}, light.group);
        else
            group = group_of_light(id, node, light);
        groups_.light_nodes[id] = group;
        std::vector<Id<Light>>& lights = groups_.groups[size_t(group)].lights;
        if (std::ranges::find(lights, node.light) == lights.end()) lights.push_back(node.light);
    }

    // Several nodes may have one light: then the group has the name of the light, if there is one.
    int group_of_light(Id<Node> id, const Node& node, const Light& light) {
        const size_t count = groups_.groups.size();
        const int group = index_of({KeyKind::light, node.light.value, {}}, node_name(scene_, id, node));
        if (groups_.groups.size() == count && !light.name.empty()) groups_.groups[size_t(group)].name = light.name;
        return group;
    }

    void add_surfaces(Id<Node> id, const Node& node, const Mesh& mesh) {
        for (const MeshPart& part : mesh.parts) {
            const Material* material = scene_.materials.find(part.material);
            if (!material || !is_emissive(*material)) continue;
            if (material->unlit) {
                const int group = index_of({KeyKind::unlit, 0, {}}, "Unlit surfaces");
                groups_.groups[size_t(group)].unlit = true;
                groups_.surface_materials[part.material] = group;
                continue;
            }
            const int group = group_of_surface(id, node, part.material, *material);
            std::vector<Id<Material>>& materials = groups_.groups[size_t(group)].materials;
            if (std::ranges::find(materials, part.material) == materials.end()) materials.push_back(part.material);
        }
    }

    int group_of_surface(Id<Node> id, const Node& node, Id<Material> material_id, const Material& material) {
        if (by_ == Grouping::by_light || by_ == Grouping::by_object)
            return groups_.surface_nodes[id] = index_of({KeyKind::object, id.value, {}}, node_name(scene_, id, node));
        const std::string name = material.name.empty() ? fmt::format("Material {}", material_id.value) : material.name;
        const Key key = by_ == Grouping::by_hand ? Key{KeyKind::hand, 0, name} : Key{KeyKind::material, material_id.value, {}};
        return groups_.surface_materials[material_id] = index_of(key, name);
    }

    void make_names_unique() {
        std::set<std::string> taken;
        for (LightGroup& group : groups_.groups) {
            const std::string name = group.name;
            for (int n = 2; !taken.insert(group.name).second; ++n) group.name = fmt::format("{} {}", name, n);
        }
    }

    // Too many groups: those with mix channels keep their planes, then as many others as fit.
    void share_last_plane() {
        std::vector<LightGroup>& all = groups_.groups;
        const size_t count = all.size();
        if (count <= most_) return;
        std::vector<int> order(count), place(count);
        for (size_t i = 0; i < count; ++i) order[i] = int(i);
        std::ranges::stable_partition(order, [&](int i) {
            return std::ranges::any_of(scene_.mix.channels, [&](const MixChannel& c) { return c.group == all[size_t(i)].name; });
        });
        const size_t last = most_ - 1;
        std::vector<LightGroup> kept;
        LightGroup rest{.name = fmt::format("{} others", count - last)};
        for (size_t at = 0; at < count; ++at) {
            LightGroup& group = all[size_t(order[at])];
            place[size_t(order[at])] = int(std::min(at, last));
            if (at < last) {
                kept.push_back(std::move(group));
                continue;
            }
            rest.lights.insert(rest.lights.end(), group.lights.begin(), group.lights.end());
            rest.materials.insert(rest.materials.end(), group.materials.begin(), group.materials.end());
            rest.environment |= group.environment;
            rest.unlit |= group.unlit; // then the rest cannot be scaled
        }
        kept.push_back(std::move(rest));
        all = std::move(kept);
        groups_.sharing = int(count - last);
        const auto move = [&](auto& map) {
            for (auto& [id, group] : map) group = place[size_t(group)];
        };
        move(groups_.light_nodes);
        move(groups_.surface_nodes);
        move(groups_.surface_materials);
        groups_.environment = place[size_t(groups_.environment)];
    }

    const Scene& scene_;
    Grouping by_;
    size_t most_;
    LightGroups groups_;
    std::map<Key, int> known_;
};

template <class Id> int found(const std::map<Id, int>& map, Id id, int otherwise) {
    const auto it = map.find(id);
    return it == map.end() ? otherwise : it->second;
}

// Of scenes with solo applied, which leaves the flag in records that nothing uses.
bool same_but_for_emission(Light before, const Light& after) {
    before.name = after.name;
    before.color = after.color;
    before.use_temperature = after.use_temperature;
    before.kelvin = after.kelvin;
    before.green_tint = after.green_tint;
    before.intensity = after.intensity;
    before.unit = after.unit;
    before.keep_power = after.keep_power;
    before.group = after.group;
    before.enabled = after.enabled;
    before.solo = after.solo;
    return before == after;
}

bool same_but_for_emission(Environment before, const Environment& after) {
    before.color = after.color;
    before.intensity = after.intensity;
    before.group = after.group;
    return before == after;
}

Vec3 shown_emission(const Light& light) { return light.enabled ? light_emission(light) : Vec3{0, 0, 0}; }

// The factor of a group, narrowed down member by member. A black member that stays black fits any factor.
class Factor {
public:
    // False: there is no common factor.
    bool meets(const Vec3& before, const Vec3& after) {
        return meets(x_, before.x, after.x) && meets(y_, before.y, after.y) && meets(z_, before.z, after.z);
    }
    Vec3 value() const { return {x_.value_or(1), y_.value_or(1), z_.value_or(1)}; }

private:
    static bool meets(std::optional<float>& known, float before, float after) {
        constexpr float rounding = 1e-6f;
        if (before == 0) return after == 0;
        const float factor = after / before;
        if (!std::isfinite(factor)) return false;
        if (!known) known = factor;
        return std::abs(factor - *known) <= rounding * *known;
    }
    std::optional<float> x_, y_, z_;
};

// Change of a group's light since the planes were rendered.
std::optional<Vec3> factor_between(const LightGroup& group, const Scene& before, const Scene& now) {
    Factor factor;
    const auto light = [&](Id<Light> id) {
        return factor.meets(shown_emission(*before.lights.find(id)), shown_emission(*now.lights.find(id)));
    };
    const auto surface = [&](Id<Material> id) {
        return factor.meets(emission_of(*before.materials.find(id)), emission_of(*now.materials.find(id)));
    };
    if (!std::ranges::all_of(group.lights, light) || !std::ranges::all_of(group.materials, surface)) return std::nullopt;
    if (group.environment && !factor.meets(environment_scale(before.environment), environment_scale(now.environment))) return std::nullopt;
    return factor.value();
}

// Copies the names that groups are made from.
Scene with_names_of(Scene scene, const Scene& now) {
    const auto rename = [](auto& table, const auto& named) {
        for (const auto id : std::decay_t<decltype(table)>::changed(table, named)) {
            auto record = *table.find(id);
            record.name = named.find(id)->name;
            if constexpr (requires { record.group; }) record.group = named.find(id)->group;
            table.set(id, std::move(record));
        }
    };
    rename(scene.nodes, now.nodes);
    rename(scene.lights, now.lights);
    rename(scene.materials, now.materials);
    scene.environment.group = now.environment.group;
    return scene;
}

bool same_members(const LightGroups& a, const LightGroups& b) {
    const auto same = [](const LightGroup& x, const LightGroup& y) {
        return x.lights == y.lights && x.materials == y.materials && x.environment == y.environment && x.unlit == y.unlit;
    };
    return std::ranges::equal(a.groups, b.groups, same) && a.light_nodes == b.light_nodes && a.surface_nodes == b.surface_nodes &&
           a.surface_materials == b.surface_materials && a.environment == b.environment;
}

// True if only emission, names and the mix differ.
bool only_emission_differs(const Scene& before, const Scene& now, const Changes& changes) {
    if (!changes.only_light()) return false;
    const auto same = [](const auto& a, const auto& b, const auto& ids) {
        return std::ranges::all_of(ids, [&](auto id) {
            const auto *x = a.find(id), *y = b.find(id);
            return x && y && same_but_for_emission(*x, *y);
        });
    };
    return same_but_for_emission(before.environment, now.environment) && same(before.lights, now.lights, changes.lights) &&
           same(before.materials, now.materials, changes.materials);
}

// True if no dark surface became emissive: dark surfaces are in no plane.
bool no_surface_becomes_emissive(const Scene& before, const Scene& now) {
    for (const Id<Material> id : Table<Material>::changed(before.materials, now.materials)) {
        const Material *a = before.materials.find(id), *b = now.materials.find(id);
        if (a && b && is_black(emission_of(*a)) && !is_black(emission_of(*b))) return false;
    }
    return true;
}

} // namespace

bool same_but_for_emission(Material before, const Material& after) {
    before.name = after.name;
    before.emissive = after.emissive;
    before.emissive_strength = after.emissive_strength;
    before.solo = after.solo;
    return before == after;
}

int LightGroups::of_light(Id<Node> node) const { return found(light_nodes, node, 0); }

int LightGroups::of_surface(Id<Node> node, Id<Material> material) const {
    if (node.value & expanded_id_bit) return of_light(Id<Node>{node.value & ~expanded_id_bit});
    return found(surface_materials, material, found(surface_nodes, node, 0));
}

LightGroups make_light_groups(const Scene& scene, int most) {
    const Scene applied = with_solo_applied(scene);
    return Grouper(applied, most).made();
}

Vec3 channel_gain(const LightMix& mix, const std::string& group) {
    for (const MixChannel& c : mix.channels) {
        if (c.group != group) continue;
        if (!c.enabled) return {0, 0, 0};
        return (c.use_temperature ? c.color * black_body_color(c.kelvin) : c.color) * c.intensity;
    }
    return {1, 1, 1};
}

std::optional<Mixing> mixing_of(const LightGroups& groups, const Scene& scene, const Changes& changes) {
    const Scene& base = groups.base;
    const Scene now = with_solo_applied(scene);
    if (base.mix.grouping != now.mix.grouping || !only_emission_differs(base, now, changes) || !no_surface_becomes_emissive(base, now))
        return std::nullopt;
    Scene renamed = with_names_of(base, now);
    if (groups.sharing > 0) renamed.mix = now.mix; // channels decide which groups have a plane
    const bool same_names = renamed == base;
    const LightGroups named = same_names ? LightGroups{} : make_light_groups(renamed);
    if (!same_names && !same_members(groups, named)) return std::nullopt;
    const std::vector<LightGroup>& members = same_names ? groups.groups : named.groups;

    Mixing mixing;
    for (const LightGroup& group : members) {
        const std::optional<Vec3> factor = factor_between(group, base, now);
        if (!factor) return std::nullopt;
        mixing.names.push_back(group.name);
        mixing.factors.push_back(*factor);
        mixing.channels.push_back(group.unlit ? Vec3{1, 1, 1} : channel_gain(now.mix, group.name));
        mixing.gains.push_back(group.unlit ? Vec3{1, 1, 1} : *factor * mixing.channels.back());
    }
    return mixing;
}

std::optional<Mixing> compared_mixing(const LightGroups& groups, const Scene& now) {
    return mixing_of(groups, now, diff(groups.base, {}, with_solo_applied(now), {}));
}

} // namespace blush
