#include "render/compile/render_scene.h"

#include "core/math.h"
#include "render/compile/expanded_lights.h"
#include "render/film/shadow_catcher.h"
#include "render/lights/missing_light.h"
#include "render/materials/material_factors.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace blush {
namespace {

// Kernels may read element 0 before they apply masks: one triangle
// that rays cannot hit, so that an empty scene is no special case.
std::vector<SceneObject> placeholder_objects() {
    static const GeometryPtr point = [] {
        auto g = std::make_shared<Geometry>();
        g->positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
        g->indices = {0, 1, 2};
        return g;
    }();
    return {{Id<Node>{}, {{point, Id<Material>{}}}, Affined{}, false}};
}

AttributeNeeds needs_of(const Scene& scene, const std::vector<SceneObject>& objects, const std::vector<int>& uv_sets) {
    AttributeNeeds needs;
    needs.uv_sets.assign(uv_sets.size(), -1);
    for (const SceneObject& object : objects)
        for (const MeshPart& part : object.parts) {
            if (!part.geometry->colors.empty()) needs.colors = true;
            const Material* m = scene.materials.find(part.material);
            if (!m) continue;
            const TextureReads reads = texture_reads(*m);
            for (size_t set = 0; set < uv_sets.size(); ++set)
                if (reads.uv_sets.contains(uv_sets[set])) needs.uv_sets[set] = uv_sets[set];
            needs.tangents |= reads.tangents;
        }
    return needs;
}

uint32_t ray_mask(bool visible_to_camera) { return other_ray_mask | (visible_to_camera ? camera_ray_mask : 0); }

bool has_catchers(const Scene& scene) {
    return std::ranges::any_of(scene.nodes, [](const auto& entry) { return entry.value.shadow_catcher; });
}

// Ray masks by object: meshes of area lights may be hidden from the camera, and shadow catchers always are.
std::vector<uint32_t> masks_of(const Scene& expanded, const std::vector<SceneObject>& objects, const CasterSets& casters) {
    std::vector<uint32_t> masks;
    const bool any_catches = has_catchers(expanded);
    for (const SceneObject& object : objects) {
        const Light* light = light_of_expanded_mesh(expanded, object.node);
        const bool catches = any_catches && is_shadow_catcher(expanded, object.node);
        const bool seen = !catches && (!light || light->visible_to_camera);
        masks.push_back(ray_mask(seen) | (catches ? catcher_ray_mask : 0) | casters.mask_of(expanded, object.node));
    }
    return masks;
}

} // namespace

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

void RenderScene::update_geometry(const Scene& scene, const UpdatePlan& plan, const Workers& workers) {
    const bool materials_changed = plan.all_materials || !plan.materials.empty();
    if (!plan.objects && !plan.transforms && !materials_changed && !plan.lights) return;

    std::vector<SphereLight> spheres = list_sphere_lights(scene);
    const bool spheres_changed = spheres != spheres_;
    spheres_ = std::move(spheres);
    bool rebuild = plan.objects, commit = plan.objects;
    if (plan.objects || plan.transforms || spheres_changed) {
        left_out_.clear();
        std::vector<SceneObject> objects = list_objects(scene, &left_out_);
        baked_.bake(scene, objects, left_out_);
        has_geometry_ = !objects.empty();
        if (objects.empty()) objects = placeholder_objects();
        const auto same = [](const SceneObject& a, const SceneObject& b) { return a.same_shape(b); };
        rebuild |= !std::equal(objects.begin(), objects.end(), objects_.begin(), objects_.end(), same);
        std::swap(objects, objects_);
        extent_ = extents_.extent_of(objects_, spheres_);
        const AttributeNeeds needs = needs_of(scene, objects_, materials_.uv_sets);
        rebuild |= needs != needs_;
        if (!rebuild) geometry_.move(objects, objects_, extent_.origin);
        needs_ = needs;
        commit = true;
    } else if (const AttributeNeeds needs = needs_of(scene, objects_, materials_.uv_sets); needs != needs_) {
        needs_ = needs;
        rebuild = true;
    }
    if (rebuild) {
        geometry_.build(objects_, needs_, extent_.origin);
        commit = true;
    }

    std::vector<bool> alpha;
    catchers_.clear();
    tables_.panes = false;
    for (size_t part = 0; part < geometry_.parts().size(); ++part) {
        const Id<Material> id = geometry_.part_materials()[part];
        geometry_.parts()[part].material = materials_.index_of(id);
        const Material* material = scene.materials.find(id);
        alpha.push_back(material && material->alpha != Material::Alpha::opaque);
        tables_.panes |= material && may_pass_straight(*material);
    }
    if (has_catchers(scene))
        for (const PartRecord& part : geometry_.parts()) catchers_.push_back(is_shadow_catcher(scene, Id<Node>{uint32_t(part.object)}));
    if (std::ranges::find(catchers_, 1) == catchers_.end()) catchers_.clear();
    casters_ = CasterSets(scene);
    std::vector<uint32_t> masks = masks_of(scene, objects_, casters_);
    commit |= alpha != alpha_ || masks != masks_;
    alpha_ = std::move(alpha);
    masks_ = std::move(masks);
    geometry_.fill(tables_);
    if (commit) accel_.commit(accel_scene(scene), &tables_, workers);
}

AccelScene RenderScene::accel_scene(const Scene& expanded) const {
    AccelScene scene = has_geometry_ ? geometry_.accel_scene(objects_, alpha_, masks_) : AccelScene{};
    for (const SphereLight& s : spheres_)
        scene.spheres.push_back(
            {to_float(s.center - extent_.origin), float(s.radius), ray_mask(s.visible_to_camera) | casters_.mask_of(expanded, s.node)});
    return scene;
}

void RenderScene::update_groups(const LightGroups& groups) {
    for (size_t part = 0; part < geometry_.parts().size(); ++part)
        group_of_part_.push_back(groups.of_surface(Id<Node>{uint32_t(geometry_.parts()[part].object)}, geometry_.part_materials()[part]));
    for (size_t i = 0; i < lights_.records.size(); ++i) {
        const LightRecord& light = lights_.records[i];
        if (!lights_.nodes[i])
            group_of_light_.push_back(groups.of_environment());
        else if (light.kind == int32_t(LightKind::triangle))
            group_of_light_.push_back(group_of_part_[size_t(light.part)]);
        else
            group_of_light_.push_back(groups.of_light(lights_.nodes[i]));
    }
}

void RenderScene::aim(std::span<const Vec3> gains) {
    std::vector<double> factors;
    for (const int32_t group : group_of_light_) factors.push_back(double(luminance(gains[size_t(group)])));
    set_light_weights(lights_, factors);
    lights_.fill(tables_.lights);
}

// Casters only matter if rays can find light, and Strategy::bsdf excludes caustic guiding.
void RenderScene::update_caustic_casters(const Scene& scene, const RenderSettings& settings) {
    const bool found = lights_.emissive_triangles + lights_.sphere_lights > 0 || !lights_.suns.empty();
    const bool narrow_sky = lights_.environment >= 0 && scene.environment.kind != Environment::Kind::constant;
    caustic_casters_.build(scene, objects_, extent_.origin, settings.strategy != Strategy::bsdf && (found || narrow_sky));
    tables_.caustic_casters = caustic_casters_.tables();
}

void RenderScene::update_lights(const Scene& scene, const RenderSettings& settings, const UpdatePlan& plan, const LightGroups* groups) {
    // An environment without light needs no map, and without NEE no importance map. Linked lights need records, and are sampled
    // by NEE where rays must not find them.
    const NeeLights aim_before = aim_;
    aim_ = settings.strategy == Strategy::bsdf && !has_links(scene) ? NeeLights::zero_size_lights : NeeLights::all_lights;
    const bool needs_map = gives_light(scene.environment);
    if (plan.environment_map || aim_ != aim_before || (plan.environment_parameters && needs_map != has_environment_map_))
        environment_ = build_environment_table(needs_map ? scene.environment : Environment{}, aim_ == NeeLights::all_lights);
    if (plan.environment_map || aim_ != aim_before || plan.environment_parameters)
        update_environment_parameters(environment_, scene.environment);
    has_environment_map_ = needs_map;
    tables_.environment = environment_.tables();
    if (!plan.lights) return;
    const Vec3d mean = environment_.integral() * (1 / (4 * std::numbers::pi));
    // A backdrop is visible but lights nothing.
    const bool emits_light = scene.environment.lights_scene && needs_map && environment_.emits_light;
    lights_ = build_light_table(scene, materials_, geometry_, tables_, spheres_, {emits_light, to_float(mean)}, extent_, aim_);
    lights_.fill(tables_.lights);
    update_caustic_casters(scene, settings);
    group_of_light_.clear();
    group_of_part_.clear();
    if (groups) update_groups(*groups);
    links_ = build_light_links(scene, lights_, geometry_, casters_);
    tables_.links = links_.empty() ? LinkTables{} : links_.tables();
    missing_light_ = blush::missing_light(scene, geometry_.part_materials());
    tables_.groups = {group_of_light_.data(), group_of_part_.data(), groups ? groups->of_environment() : 0};
}

Features RenderScene::compute_features(const Scene& scene, const RenderSettings& settings) const {
    Features f;
    const auto add = [&](Feature feature, bool needed) {
        if (needed) f = f.with(feature);
    };
    for (const Id<Material> id : geometry_.part_materials()) {
        const Material* material = scene.materials.find(id);
        f.bits |= features_of(material ? *material : Material{}).bits;
    }
    add(Feature::vertex_colors, needs_.colors);
    add(Feature::instances, geometry_.instance_count() > 0);
    f = f.without(Feature::emissive_triangles);
    add(Feature::emissive_triangles, lights_.emissive_triangles > 0);
    add(Feature::point_lights, lights_.point_lights > 0);
    add(Feature::suns, lights_.sun_lights > 0);
    add(Feature::sphere_lights, lights_.sphere_lights > 0);
    add(Feature::light_tree, !lights_.tree.nodes.empty());
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
    const Vec3d origin_before = extent_.origin;
    update_materials(scene, plan, workers);
    update_geometry(scene, plan, workers);
    update_lights(scene, settings, plan, groups);
    geometry_.fill(tables_);
    if (plan.camera || extent_.origin != origin_before)
        tables_.camera = camera_record(scene.view, float(settings.width) / float(settings.height), extent_.origin);
    if (plan.features) features_ = compute_features(scene, settings);
}

Id<Material> RenderScene::material_id(int32_t index) const {
    return index > 0 && size_t(index) <= materials_.ids.size() ? materials_.ids[size_t(index) - 1] : Id<Material>{};
}

} // namespace blush
