// Objects, vertices and BVH of a compiled scene. Edits of lights read no objects but the meshes of area lights.
#include "render/compile/expanded_lights.h"
#include "render/compile/render_scene.h"
#include "render/film/shadow_catcher.h"
#include "scene/affine.h"
#include "scene/world_transforms.h"

#include <algorithm>

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

AttributeNeeds needs_of(const UsedMaterials& used, bool has_colors, const std::vector<int>& uv_sets) {
    AttributeNeeds needs;
    needs.colors = has_colors;
    needs.tangents = used.tangents;
    for (const int set : uv_sets) needs.uv_sets.push_back(used.uv_sets.contains(set) ? set : -1);
    return needs;
}

uint32_t ray_mask(bool visible_to_camera) { return other_ray_mask | (visible_to_camera ? camera_ray_mask : 0); }

bool has_catchers(const Scene& scene) {
    return std::ranges::any_of(scene.nodes, [](const auto& entry) { return entry.value.shadow_catcher; });
}

// Ray mask of an object: meshes of area lights may be hidden from the camera, and shadow catchers always are.
uint32_t mask_of(const Scene& expanded, const SceneObject& object, const CasterSets& casters, bool any_catches) {
    if (object.disabled) return 0;
    const Light* light = light_of_expanded_mesh(expanded, object.node);
    const bool catches = any_catches && is_shadow_catcher(expanded, object.node);
    const bool seen = !catches && (!light || light->visible_to_camera);
    return ray_mask(seen) | (catches ? catcher_ray_mask : 0) | casters.mask_of(expanded, object.node);
}

bool same_shapes(const std::vector<SceneObject>& a, const std::vector<SceneObject>& b) {
    return std::ranges::equal(a, b, [](const SceneObject& x, const SceneObject& y) { return x.same_shape(y); });
}

} // namespace

// Returns the objects before.
std::vector<SceneObject> RenderScene::relist_objects(const Scene& scene) {
    left_out_.clear();
    std::vector<SceneObject> objects = list_objects(scene, &left_out_);
    baked_.bake(scene, objects, left_out_);
    has_geometry_ = !objects.empty();
    if (objects.empty()) objects = placeholder_objects();
    std::swap(objects, objects_);
    area_lights_.clear();
    has_colors_ = false;
    for (size_t i = 0; i < objects_.size(); ++i) {
        if (is_expanded(objects_[i].node)) area_lights_.push_back(i);
        for (const MeshPart& part : objects_[i].parts) has_colors_ |= !part.geometry->colors.empty();
    }
    has_catchers_ = has_catchers(scene);
    return objects;
}

// Moves meshes of area lights. False if all objects must be listed again: a mesh is shared, its transform is or was not finite, or it is
// now, or no longer, a shadow catcher.
bool RenderScene::move_area_lights(const Scene& scene, const std::vector<Id<Node>>& moved) {
    if (moved.empty()) return true;
    std::map<Id<Node>, size_t> area_lights;
    for (const size_t i : area_lights_) area_lights.emplace(objects_[i].node, i);
    WorldTransforms transforms(scene);
    std::vector<std::pair<size_t, Affined>> places;
    for (const Id<Node> id : moved) {
        const NodeTransform& place = transforms(id);
        if (!place.visible) continue;
        const auto area_light = area_lights.find(id);
        if (area_light == area_lights.end() || objects_[area_light->second].instanced || !is_finite(place.world_from_node)) return false;
        const bool catches = (masks_[area_light->second] & catcher_ray_mask) != 0;
        if (has_catchers_ && is_shadow_catcher(scene, id) != catches) return false;
        places.emplace_back(area_light->second, place.world_from_node);
    }
    for (const auto& [i, place] : places) objects_[i].world_from_object = place;
    changed_.area_lights = true;
    return true;
}

// Disables and enables meshes of area lights.
void RenderScene::switch_area_lights(const Scene& scene) {
    for (const size_t i : area_lights_) {
        const bool disabled = is_disabled_mesh(scene, objects_[i].node);
        changed_.area_lights |= disabled != objects_[i].disabled;
        objects_[i].disabled = disabled;
    }
}

// What the materials of objects need, if objects or these materials changed.
void RenderScene::update_used_materials(const Scene& scene, const UpdatePlan& plan) {
    if (!changed_.objects && !plan.all_materials && plan.materials.empty()) return;
    UsedMaterials used = describe(changed_.objects ? material_ids_of(objects_) : used_.ids, scene, materials_);
    const auto emits = [&](Id<Material> id) {
        return std::ranges::binary_search(used_.emissive, id) || std::ranges::binary_search(used.emissive, id);
    };
    changed_.emission = plan.all_materials || std::ranges::any_of(plan.materials, emits);
    changed_.emitters = used.emissive != used_.emissive;
    changed_.casters = used.casters != used_.casters || used.weak_casters != used_.weak_casters;
    changed_.alpha = used.alpha != used_.alpha;
    used_ = std::move(used);
    changed_.casters |=
        smoothness_.update(scene, objects_, used_.smooth_by_texture, plan.all_materials ? nullptr : &plan.materials, materials_);
    used_.smooth.mirror |= smoothness_.largest().is_mirror > 0;
    used_.smooth.glass |= smoothness_.largest().is_glass > 0;
    tables_.blends = used_.blends;
    tables_.panes = used_.panes;
}

// Places all vertices again, or moves those of moved objects.
void RenderScene::update_vertices(const UpdatePlan& plan, const std::vector<SceneObject>& before) {
    AttributeNeeds needs = needs_of(used_, has_colors_, materials_.uv_sets);
    const bool rebuild = plan.objects || needs != needs_ || (changed_.objects && !same_shapes(before, objects_));
    needs_ = std::move(needs);
    if (rebuild)
        geometry_.build(objects_, needs_, extent_.origin);
    else if (changed_.objects || changed_.origin)
        geometry_.move(changed_.objects ? before : objects_, objects_, extent_.origin);
    else if (changed_.area_lights)
        for (const size_t i : area_lights_)
            if (!objects_[i].instanced) geometry_.move_flat(i, objects_[i]);
    changed_.objects |= rebuild;
    geometry_.set_materials(materials_);
    if (changed_.objects || changed_.emitters) emissive_parts_ = geometry_.parts_of(objects_, used_.emissive);
}

void RenderScene::update_masks(const Scene& scene) {
    if (changed_.objects) {
        catchers_.clear();
        if (has_catchers_)
            for (const PartRecord& part : geometry_.parts()) catchers_.push_back(is_shadow_catcher(scene, Id<Node>{uint32_t(part.object)}));
        if (std::ranges::find(catchers_, 1) == catchers_.end()) catchers_.clear();
    }
    CasterSets casters(scene, light_nodes_);
    const bool all = changed_.objects || casters != casters_;
    casters_ = std::move(casters);
    const auto mask = [&](const SceneObject& object) { return mask_of(scene, object, casters_, has_catchers_); };
    changed_.masks = all;
    if (all) {
        masks_.clear();
        for (const SceneObject& object : objects_) masks_.push_back(mask(object));
        return;
    }
    for (const size_t i : area_lights_) {
        const uint32_t now = mask(objects_[i]);
        if (now == masks_[i]) continue;
        masks_[i] = now;
        (objects_[i].instanced ? changed_.masks : changed_.area_lights) = true;
    }
}

void RenderScene::update_sphere_masks(const Scene& scene) {
    std::vector<uint32_t> masks;
    for (const SphereLight& s : spheres_) masks.push_back(ray_mask(s.visible_to_camera) | casters_.mask_of(scene, s.node));
    changed_.spheres |= masks != sphere_masks_;
    sphere_masks_ = std::move(masks);
}

void RenderScene::update_geometry(const Scene& scene, const UpdatePlan& plan, const Workers& workers) {
    const bool materials_changed = plan.all_materials || !plan.materials.empty();
    if (!plan.objects && !plan.transforms && !materials_changed && !plan.lights) return;

    if (plan.objects || !std::ranges::equal(light_ids_, scene.lights, {}, {}, &Table<Light>::Entry::id)) {
        light_nodes_ = nodes_with_lights(scene);
        light_ids_.clear();
        for (const auto& [id, light] : scene.lights) light_ids_.push_back(id);
    }
    std::vector<SphereLight> spheres = list_sphere_lights(scene, light_nodes_);
    changed_.spheres = spheres != spheres_;
    spheres_ = std::move(spheres);
    changed_.objects = plan.objects || plan.transforms || !move_area_lights(scene, plan.moved_area_lights);
    const std::vector<SceneObject> before = changed_.objects ? relist_objects(scene) : std::vector<SceneObject>{};

    switch_area_lights(scene);

    const Vec3d origin_before = extent_.origin;
    if (changed_.objects)
        extent_ = extents_.extent_of(objects_, spheres_);
    else if (changed_.area_lights || changed_.spheres)
        extent_ = extents_.with_moved_area_lights(objects_, spheres_);
    changed_.origin = extent_.origin != origin_before;

    update_used_materials(scene, plan);
    update_vertices(plan, before);
    update_masks(scene);
    update_sphere_masks(scene);
    geometry_.fill(tables_);
    update_accel(workers);
}

void RenderScene::update_accel(const Workers& workers) {
    const bool all = changed_.objects || changed_.origin || changed_.alpha || changed_.masks,
               area_lights = changed_.area_lights || changed_.spheres;
    if (!all && !area_lights) return;
    changed_.bvh = true;
    if (!all && accel_.has_area_light_bvh())
        return accel_.commit_area_lights(geometry_.accel_area_lights(objects_, masks_), accel_spheres(), &tables_, workers);
    AccelScene accel = has_geometry_ ? geometry_.accel_scene(objects_, used_.alpha, masks_) : AccelScene{};
    accel.spheres = accel_spheres();
    accel_.commit(accel, &tables_, workers);
}

std::vector<AccelSphere> RenderScene::accel_spheres() const {
    std::vector<AccelSphere> spheres;
    for (size_t i = 0; i < spheres_.size(); ++i)
        spheres.push_back({to_float(spheres_[i].center - extent_.origin), float(spheres_[i].radius), sphere_masks_[i]});
    return spheres;
}

} // namespace blush
