#include "ui/lights/light_rows.h"

#include "scene/animation/pose.h"
#include "scene/lights/light_visibility.h"
#include "scene/node_name.h"
#include "scene/world_transforms.h"
#include "ui/lights/light_groups.h"
#include "ui/lights/light_tools.h"
#include "ui/lights/multi_edit.h"

#include <algorithm>
#include <map>
#include <set>

namespace blush {
namespace {

const char* type_of(const Environment& e) {
    switch (e.kind) {
    case Environment::Kind::none: break;
    case Environment::Kind::constant: return "Colour";
    case Environment::Kind::image: return "Image";
    case Environment::Kind::sky: return "Sky";
    }
    return "";
}

class Collector {
public:
    explicit Collector(const Scene& scene) : scene_(scene), some_solo_(any_solo(scene)) {}

    void light(Id<Node> id, const Node& node, const Light& light, bool visible) {
        groups_[light.group].push_back({id,
                                        node.light,
                                        {},
                                        false,
                                        node_name(scene_, id, node),
                                        kind_name(light.kind),
                                        light.intensity,
                                        intensity_unit(light.kind),
                                        light.enabled,
                                        light.solo,
                                        visible && emits_light(light, some_solo_)});
    }
    void materials(Id<Node> id, const Mesh& mesh) {
        for (const MeshPart& part : mesh.parts) {
            const Material* m = scene_.materials.find(part.material);
            if (!m || !has_emission(*m) || !seen_.insert(part.material).second) continue;
            glowing_.push_back({id,
                                {},
                                part.material,
                                false,
                                m->name.empty() ? mesh.name : m->name,
                                "Surface",
                                m->emissive_strength,
                                "×",
                                m->emits,
                                m->solo,
                                emits_light(*m, some_solo_)});
        }
    }
    std::vector<LightRows> finish() {
        std::vector<LightRow>& ungrouped = groups_[""];
        ungrouped.insert(ungrouped.end(), glowing_.begin(), glowing_.end());
        const Environment& e = scene_.environment;
        if (e.kind != Environment::Kind::none)
            groups_[e.group].push_back({{},
                                        {},
                                        {},
                                        true,
                                        "Environment",
                                        type_of(e),
                                        e.intensity,
                                        e.kind == Environment::Kind::constant ? "nits" : "×",
                                        e.lights_scene,
                                        e.solo,
                                        emits_light(e, some_solo_)});
        std::vector<LightRows> all;
        for (auto& [group, rows] : groups_)
            if (!group.empty()) all.push_back({group, std::move(rows)});
        if (!groups_[""].empty()) all.push_back({"", std::move(groups_[""])});
        return all;
    }

private:
    const Scene& scene_;
    bool some_solo_;
    std::map<std::string, std::vector<LightRow>> groups_;
    std::vector<LightRow> glowing_;
    std::set<Id<Material>> seen_;
};

} // namespace

std::vector<LightRows> light_rows(const Scene& scene) {
    Collector collector(scene);
    WorldTransforms placements(scene);
    for (const auto& [id, node] : scene.nodes) {
        const bool visible = placements(id).visible;
        const Light* light = scene.lights.find(node.light);
        if (light && is_in_chosen_scene(scene, id)) collector.light(id, node, *light, visible);
        if (const Mesh* mesh = scene.meshes.find(node.mesh); mesh && visible) collector.materials(id, *mesh);
    }
    return collector.finish();
}

Edit with_switches(const Scene& scene, const LightRow& row, bool on, bool solo) {
    if (row.light) {
        Light light = *scene.lights.find(row.light);
        light.enabled = on;
        light.solo = solo;
        return SetLight{row.light, std::move(light)};
    }
    if (row.material) {
        Material material = *scene.materials.find(row.material);
        material.emits = on;
        material.solo = solo;
        return SetMaterial{row.material, std::move(material)};
    }
    Environment e = scene.environment;
    e.lights_scene = on;
    e.solo = solo;
    return SetEnvironment{std::move(e)};
}

std::optional<RowShare> share_of(const LightRow& row, const LightGroups& groups, std::span<const GroupReport> reports) {
    if (row.light && !groups.light_nodes.contains(row.node)) return {};
    if (row.material && !groups.surface_materials.contains(row.material) && !groups.surface_nodes.contains(row.node)) return {};
    const size_t k = size_t(row.environment ? groups.of_environment()
                            : row.light     ? groups.of_light(row.node)
                                            : groups.of_surface(row.node, row.material));
    if (k >= reports.size() || k >= groups.groups.size()) return {};
    const LightGroup& group = groups.groups[k];
    const size_t members = group.lights.size() + group.materials.size() + group.environment;
    return RowShare{reports[k].energy, reports[k].noise, members == 1};
}

std::vector<Edit> put_into_group(const Scene& scene, std::span<const Id<Light>> lights, bool environment, const std::string& group) {
    std::vector<Edit> edits = change_lights(scene, lights, [&](Light& light) { light.group = group; });
    if (environment && scene.environment.group != group) {
        Environment e = scene.environment;
        e.group = group;
        edits.push_back(SetEnvironment{e});
    }
    return edits;
}

std::vector<Edit> rename_group(const Scene& scene, const std::string& group, const std::string& name) {
    std::vector<Id<Light>> lights;
    for (const auto& [id, light] : scene.lights)
        if (light.group == group) lights.push_back(id);
    return put_into_group(scene, lights, scene.environment.group == group, name);
}

} // namespace blush
