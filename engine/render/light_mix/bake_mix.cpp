#include "render/light_mix/bake_mix.h"

#include "core/math.h"
#include "render/light_mix/light_groups.h"
#include "scene/document/scene_selection.h"
#include "scene/world_transforms.h"

#include <algorithm>
#include <map>
#include <utility>

namespace blush {
namespace {

// Scales colour and strength of a light, a material or the environment so that their product changes by `gain`, without raising
// colour components above their maximum.
void scale(Vec3& color, float& strength, const Vec3& gain) {
    const float brightest = max_component(gain);
    color = brightest > 0 ? color * (gain / brightest) : color;
    strength *= brightest;
}

void scale(Light& light, const Vec3& gain) {
    // A light that is switched off keeps its values.
    if (gain == Vec3{0, 0, 0})
        light.enabled = false;
    else
        scale(light.color, light.intensity, gain);
}
void scale(Material& material, const Vec3& gain) { scale(material.emissive, material.emissive_strength, gain); }
void scale(Environment& environment, const Vec3& gain) { scale(environment.color, environment.intensity, gain); }

// Node lists by record id, then by index of the gain.
template <class T> using Uses = std::map<Id<T>, std::map<int, std::vector<Id<Node>>>>;

class Baker {
public:
    explicit Baker(const Scene& scene) : scene_(scene), groups_(make_light_groups(scene)) {
        for (const LightGroup& group : groups_.groups) gains_.push_back(group.unlit ? Vec3{1, 1, 1} : channel_gain(scene.mix, group.name));
    }

    Scene baked() {
        // Without groups, channels have no effect.
        if (scene_.mix.grouping == LightMix::Grouping::none || groups_.groups.empty()) return cleared();
        WorldTransforms transforms(scene_);
        Uses<Light> lights;
        Uses<Material> materials;
        for (const auto& [id, node] : scene_.nodes) {
            if (!transforms(id).visible) continue;
            if (groups_.light_nodes.contains(id)) lights[node.light][first_alike(groups_.of_light(id))].push_back(id);
            if (const Mesh* mesh = scene_.meshes.find(node.mesh))
                for (const MeshPart& part : mesh->parts)
                    if (is_scaled(part.material))
                        materials[part.material][first_alike(groups_.of_surface(id, part.material))].push_back(id);
        }
        for (const auto& [id, uses] : lights)
            bake(out_.lights, id, uses, [&](Id<Node> node, Id<Light> copy) { change(node, [&](Node& n) { n.light = copy; }); });
        for (const auto& [id, uses] : materials)
            bake(out_.materials, id, uses, [&, from = id](Id<Node> node, Id<Material> copy) { give_own_mesh(node, from, copy); });
        if (scene_.environment.kind != Environment::Kind::none) scale(out_.environment, gains_[size_t(groups_.of_environment())]);
        return cleared();
    }

private:
    Scene cleared() {
        out_.mix.channels.clear();
        return std::move(out_);
    }
    // Index of the first group with the same gain.
    int first_alike(int group) const { return int(std::ranges::find(gains_, gains_[size_t(group)]) - gains_.begin()); }
    bool is_scaled(Id<Material> id) const {
        return std::ranges::any_of(groups_.groups,
                                   [&](const LightGroup& g) { return std::ranges::find(g.materials, id) != g.materials.end(); });
    }

    // The record itself gets the first gain; for each further gain it is copied, and the copy is assigned to that gain's nodes.
    template <class T, class Give>
    void bake(Table<T>& records, Id<T> id, const std::map<int, std::vector<Id<Node>>>& uses, const Give& give) {
        const T before = *records.find(id);
        bool first = true;
        for (const auto& [group, nodes] : uses) {
            T scaled = before;
            scale(scaled, gains_[size_t(group)]);
            if (std::exchange(first, false)) {
                records.set(id, scaled);
                continue;
            }
            const Id<T> copy = records.add(scaled);
            for (const Id<Node> node : nodes) give(node, copy);
        }
    }
    void give_own_mesh(Id<Node> node, Id<Material> from, Id<Material> to) {
        Mesh mesh = *out_.meshes.find(out_.nodes.find(node)->mesh);
        for (MeshPart& part : mesh.parts)
            if (part.material == from) assign_material(scene_, part, to);
        change(node, [&](Node& n) { n.mesh = out_.meshes.add(std::move(mesh)); });
    }
    template <class With> void change(Id<Node> id, const With& with) {
        Node node = *out_.nodes.find(id);
        with(node);
        out_.nodes.set(id, std::move(node));
    }

    const Scene& scene_;
    Scene out_ = scene_;
    LightGroups groups_;
    std::vector<Vec3> gains_; // of the groups' channels
};

} // namespace

BakeMix bake_mix(const Scene& scene) { return {Baker(scene).baked()}; }

} // namespace blush
