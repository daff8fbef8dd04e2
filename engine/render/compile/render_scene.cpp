#include "render/compile/render_scene.h"

#include "core/math.h"
#include "render/compile/expanded_lights.h"
#include "render/integrator/light_path_emission.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {

CameraRecord camera_record(const View& view, float aspect, const Vec3d& origin) {
    const Affine frame = to_float(to_affine(view.rotation));
    const Lens& lens = view.lens;
    const float half_height = lens.orthographic ? lens.ymag : std::tan(0.5f * lens.yfov_radians);
    CameraRecord camera{};
    camera.position = to_float(to_double(view.position) - origin);
    camera.forward = -frame.z;
    camera.right = frame.x * (half_height * aspect);
    camera.up = frame.y * half_height;
    camera.aperture_radius = lens.aperture_radius;
    camera.focus_distance = lens.focus_distance;
    camera.orthographic = lens.orthographic;
    return camera;
}

void RenderScene::update_materials(const Scene& scene, const UpdatePlan& plan, const Workers& workers) {
    bool rebuild = plan.all_materials;
    for (const Id<Material> id : plan.materials)
        if (!rebuild && !update_material(materials_, scene, id)) rebuild = true;
    if (rebuild) build_material_table(materials_, scene, &workers);
    tables_.materials = materials_.tables();
}

void RenderScene::update_groups(const LightGroups* groups) {
    group_of_light_.clear();
    tables_.groups = {};
    if (!groups) {
        group_of_part_.clear();
        grouped_ = {};
        return;
    }
    const GroupsOfIds ids{groups->light_nodes, groups->surface_nodes, groups->surface_materials};
    if (changed_.objects || group_of_part_.empty() || ids != grouped_) {
        group_of_part_.clear();
        for (size_t part = 0; part < geometry_.parts().size(); ++part)
            group_of_part_.push_back(
                groups->of_surface(Id<Node>{uint32_t(geometry_.parts()[part].object)}, geometry_.part_materials()[part]));
        grouped_ = ids;
    }
    for (size_t i = 0; i < lights_.records.size(); ++i) {
        const LightRecord& light = lights_.records[i];
        if (!lights_.nodes[i])
            group_of_light_.push_back(groups->of_environment());
        else if (light.kind == int32_t(LightKind::triangle))
            group_of_light_.push_back(group_of_part_[size_t(light.part)]);
        else
            group_of_light_.push_back(groups->of_light(lights_.nodes[i]));
    }
    tables_.groups = {group_of_light_.data(), group_of_part_.data(), groups->of_environment()};
}

void RenderScene::aim(std::span<const Vec3> gains) {
    if (gains.empty()) return; // without lights the table still has a record, of no group
    std::vector<double> factors;
    for (const int32_t group : group_of_light_) factors.push_back(double(luminance(gains[size_t(group)])));
    set_light_weights(lights_, factors);
    lights_.fill(tables_.lights);
}

// Strategy::bsdf and CausticStrategy::off exclude casters. Diffuse surfaces sample directions towards them only if rays can find light
// there. Weak reflectors are casters for small lights alone: of larger meshes and even skies, rays find the reflection.
void RenderScene::update_caustic_casters(const Scene& scene, const RenderSettings& settings) {
    const bool narrow_sky = lights_.environment >= 0 && scene.environment.kind != Environment::Kind::constant;
    const bool can_be_hit = lights_.emissive_triangles + lights_.sphere_lights > 0 || !lights_.suns.empty() || narrow_sky;
    const bool zero_size = lights_.point_lights > 0 || lights_.sun_lights > int64_t(lights_.suns.size());
    const bool allowed = settings.strategy != Strategy::bsdf && settings.caustics != CausticStrategy::off && (can_be_hit || zero_size);
    const Smoothness& textured = smoothness_.largest();
    const bool weak = !used_.weak_casters.empty() || textured.casts_caustics + textured.reflects_weakly > 0;
    const CausticCasterTable::Wanted wanted{.mirrors_and_glass = allowed, .weak_reflectors = allowed && weak};
    if (changed_.objects || changed_.origin || changed_.casters || wanted != wanted_casters_) {
        wanted_casters_ = wanted;
        caustic_casters_.build(scene, objects_, smoothness_, extent_.origin, wanted);
    }
    tables_.casters = caustic_casters_.mirrors_and_glass();
    const CausticCasterTables all = caustic_casters_.tables();
    tables_.emission_casters = emits_to_weak_reflectors(tables_, all) ? all : tables_.casters;
    tables_.guides.casters = can_be_hit ? caustic_casters_.guides() : CausticCasterTables{};
}

// Records of emissive meshes, if these, their materials or area lights changed.
void RenderScene::update_mesh_lights(const Scene& scene, bool aim_changed, const Workers& workers) {
    std::vector<float> spreads;
    for (const size_t i : area_lights_) spreads.push_back(light_of_expanded_mesh(scene, objects_[i].node)->spread_radians);
    const bool area_lights_changed = changed_.origin || changed_.area_lights || spreads != area_light_spreads_;
    if (!changed_.objects && !changed_.emission && !area_lights_changed && !aim_changed) return;
    area_light_spreads_ = std::move(spreads);
    mesh_lights_ = build_mesh_lights(scene, geometry_, tables_, emissive_parts_, aim_, mesh_lights_, workers);
    geometry_.set_first_lights(mesh_lights_.first_lights);
    changed_.lamps = clearances_.find_lamps(objects_, geometry_, mesh_lights_, workers);
}

void RenderScene::update_clearances(const Workers& workers) {
    if (changed_.bvh || changed_.lamps) clearances_.find_clear_lamps(accel_, geometry_, tables_, accel_spheres(), workers);
    tables_.lights.clearances = clearances_.boxes();
}

EnvironmentSampling RenderScene::environment_sampling(const Scene& scene, const RenderSettings& settings) const {
    if (aim_ != NeeLights::all_lights) return EnvironmentSampling::none;
    if (settings.strategy != Strategy::mis || !settings.mis_compensation) return EnvironmentSampling::full;
    return samples_other_lights(scene, mesh_lights_, light_nodes_) ? EnvironmentSampling::compensated
                                                                   : EnvironmentSampling::compensated_alone;
}

void RenderScene::update_lights(const Scene& scene, const RenderSettings& settings, const UpdatePlan& plan, const Workers& workers,
                                const LightGroups* groups) {
    // An environment without light needs no map, and without NEE no importance map. Linked lights need records, and are sampled
    // by NEE where rays must not find them.
    const NeeLights aim_before = aim_;
    aim_ = settings.strategy == Strategy::bsdf && !has_links(scene) ? NeeLights::zero_size_lights : NeeLights::all_lights;
    const bool needs_map = gives_light(scene.environment);
    if (plan.lights) update_mesh_lights(scene, aim_ != aim_before, workers);
    const EnvironmentSampling sampling = environment_sampling(scene, settings);
    if (plan.environment_map || sampling != environment_.sampling || (plan.environment_parameters && needs_map != has_environment_map_))
        environment_ = build_environment_table(needs_map ? scene.environment : Environment{}, sampling, &workers);
    if (plan.environment_map || aim_ != aim_before || plan.environment_parameters)
        update_environment_parameters(environment_, scene.environment);
    has_environment_map_ = needs_map;
    tables_.environment = environment_.tables();
    if (!plan.lights) return;
    const Vec3d mean = environment_.integral() * (1 / (4 * std::numbers::pi));
    // A backdrop is visible but lights nothing.
    const bool emits_light = scene.environment.lights_scene && needs_map && environment_.emits_light;
    lights_ = build_light_table(scene, mesh_lights_, light_nodes_, spheres_, {emits_light, to_float(mean), environment_.sampled_share},
                                extent_.origin, aim_, workers);
    lights_.fill(tables_.lights);
    update_clearances(workers);
    update_caustic_casters(scene, settings);
    update_groups(groups);
    const bool same_parts = !changed_.objects && !changed_.area_lights;
    links_ = build_light_links(scene, lights_, geometry_, casters_, same_parts ? links_ : LightLinks{});
    tables_.links = links_.empty() ? LinkTables{} : links_.tables();
    for (size_t i = 0; i < missing_light_.size(); ++i)
        missing_light_[i] = blush::missing_light(scene, light_nodes_, used_.smooth, CausticFinders(i));
}

Features RenderScene::compute_features(const Scene& scene, const RenderSettings& settings) const {
    Features f = used_.features;
    const auto add = [&](Feature feature, bool needed) {
        if (needed) f = f.with(feature);
    };
    add(Feature::vertex_colors, needs_.colors);
    add(Feature::instances, geometry_.instance_count() > 0);
    f = f.without(Feature::emissive_triangles);
    add(Feature::emissive_triangles, lights_.emissive_triangles > 0);
    add(Feature::point_lights, lights_.point_lights > 0);
    add(Feature::suns, lights_.sun_lights > 0);
    add(Feature::sphere_lights, lights_.sphere_lights > 0);
    add(Feature::light_tree, !lights_.tree.empty());
    add(Feature::light_profiles, !lights_.profiles.empty());
    const bool is_backdrop = !scene.environment.lights_scene && scene.environment.visible_to_camera && has_environment_map_;
    add(Feature::environment, lights_.environment >= 0 || is_backdrop);
    add(Feature::links, !links_.empty());
    add(Feature::energy_compensation, settings.energy_compensation);
    add(Feature::thin_lens, !scene.view.lens.orthographic && scene.view.lens.aperture_radius > 0);
    add(Feature::orthographic, scene.view.lens.orthographic);
    return f;
}

void RenderScene::update(const Scene& scene, const RenderSettings& settings, const UpdatePlan& plan, const Workers& workers,
                         const LightGroups* groups) {
    changed_ = {};
    update_materials(scene, plan, workers);
    update_geometry(scene, plan, workers);
    update_lights(scene, settings, plan, workers, groups);
    if (plan.camera || changed_.origin)
        tables_.camera = camera_record(scene.view, float(settings.width) / float(settings.height), extent_.origin);
    if (plan.features) features_ = compute_features(scene, settings);
    update_warnings();
}

Id<Material> RenderScene::material_id(int32_t index) const {
    return index > 0 && size_t(index) <= materials_.ids.size() ? materials_.ids[size_t(index) - 1] : Id<Material>{};
}

Id<Node> RenderScene::light_node(int32_t record) const {
    return record >= 0 && size_t(record) < lights_.nodes.size() ? lights_.nodes[size_t(record)] : Id<Node>{};
}

} // namespace blush
