// The compiled scene: tables that kernels read, kept up to date with the edited scene. Only this file knows both.
#pragma once

#include "core/parallel.h"
#include "render/bvh/accel.h"
#include "render/compile/baked_transforms.h"
#include "render/compile/compiled_info.h"
#include "render/compile/feature_report.h"
#include "render/compile/geometry_pool.h"
#include "render/compile/object_list.h"
#include "render/compile/part_smoothness.h"
#include "render/compile/scene_origin.h"
#include "render/compile/update_plan.h"
#include "render/compile/used_materials.h"
#include "render/film/film_size.h"
#include "render/kernels/kernel.h"
#include "render/light_mix/light_groups.h"
#include "render/lights/caustic_caster_table.h"
#include "render/lights/environment_table.h"
#include "render/lights/lamp_clearance.h"
#include "render/lights/light_links.h"
#include "render/lights/light_table.h"
#include "render/lights/mesh_lights.h"
#include "render/materials/material_table.h"

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace blush {

class RenderScene {
public:
    // Executes `plan` for a scene with expanded area lights. Afterwards all tables equal those of full_plan(). `groups`: light
    // groups of the scene; null: no light mix.
    void update(const Scene& expanded, const RenderSettings& settings, const UpdatePlan& plan, const Workers& workers,
                const LightGroups* groups = nullptr);
    // Weights light selection by the groups' gains, until the next update of lights. The image's expectation does not change.
    void aim(std::span<const Vec3> gains);

    // Positions are relative to origin().
    const SceneTables& tables() const { return tables_; }
    const Vec3d& origin() const { return extent_.origin; }
    const Accel& accel() const { return accel_; }
    // Kernel features that the scene needs under these settings.
    Features features() const { return features_; }
    // Material id of a table record; 0 for glTF's default material and for -1.
    Id<Material> material_id(int32_t index) const;
    // Node of a record of the light table; 0 for the environment and for -1.
    Id<Node> light_node(int32_t record) const;
    // Inverse of material_id(); 0 for an unknown id.
    int32_t material_index(Id<Material> id) const { return materials_.index_of(id); }
    // By part: 1 if the part is a shadow catcher (shadow_catcher.h); empty: no shadow catchers.
    const std::vector<uint8_t>& catchers() const { return catchers_; }
    // True if NEE or rays can find light.
    bool has_light() const { return lights_.count > 0 || lights_.emissive_triangles > 0 || lights_.environment >= 0; }
    // True if some surface may be Lambertian, as path reuse needs it.
    bool may_be_lambertian() const { return used_.lambertian; }
    // True if delta lobes may show lamps.
    bool may_have_highlights() const { return (used_.smooth.mirror || used_.smooth.glass) && tables_.lights.count > 0; }
    // Contains all surfaces; relative to origin().
    CasterSphere bounding_sphere() const;
    // True if a camera ray may end at something that emits light, or is unlit.
    bool camera_sees_emission() const;
    // See missing_light.h.
    const std::string& missing_light(CausticFinders finders) const { return missing_light_[size_t(finders)]; }
    // Of the last update.
    const std::shared_ptr<const std::vector<Diagnostic>>& warnings() const { return warnings_; }
    // Everything except the kernel, the feature report and light that is missing.
    CompiledInfo info() const;
    // `expanded`: the scene of the last update(); `film`: the film that is rendered to.
    FeatureReport feature_report(const Scene& expanded, const FilmSize& film) const;

private:
    void update_materials(const Scene& scene, const UpdatePlan& plan, const Workers& workers);
    void update_geometry(const Scene& scene, const UpdatePlan& plan, const Workers& workers);
    std::vector<SceneObject> relist_objects(const Scene& scene);
    bool move_area_lights(const Scene& scene, const std::vector<Id<Node>>& moved);
    void switch_area_lights(const Scene& scene);
    void update_used_materials(const Scene& scene, const UpdatePlan& plan);
    void update_vertices(const UpdatePlan& plan, const std::vector<SceneObject>& before);
    void update_masks(const Scene& scene);
    void update_sphere_masks(const Scene& scene);
    void update_accel(const Workers& workers);
    std::vector<AccelSphere> accel_spheres() const;
    void update_mesh_lights(const Scene& scene, bool aim_changed, const Workers& workers);
    void update_clearances(const Workers& workers);
    EnvironmentSampling environment_sampling(const Scene& scene, const RenderSettings& settings) const;
    void update_lights(const Scene& scene, const RenderSettings& settings, const UpdatePlan& plan, const Workers& workers,
                       const LightGroups* groups);
    void update_groups(const LightGroups* groups);
    void update_caustic_casters(const Scene& scene, const RenderSettings& settings);
    void update_warnings();
    Features compute_features(const Scene& scene, const RenderSettings& settings) const;

    // What the current update has changed so far.
    struct Changed {
        bool objects = false;     // listed again, or their vertices placed again
        bool area_lights = false; // meshes of area lights moved, were disabled or enabled, or their masks changed
        bool spheres = false;     // sphere lights
        bool origin = false;      // of all positions
        bool emission = false;    // materials of emissive meshes
        bool emitters = false;    // which materials emit
        bool casters = false;     // which surfaces cast caustics
        bool alpha = false;       // which materials are not opaque
        bool masks = false;       // ray masks of objects other than flat meshes of area lights
        bool bvh = false;         // or the part of it that holds area lights
        bool lamps = false;       // emissive meshes that may stand clear
    };
    // Members of light groups (light_groups.h).
    struct GroupsOfIds {
        std::map<Id<Node>, int> light_nodes, surface_nodes;
        std::map<Id<Material>, int> surface_materials;
        bool operator==(const GroupsOfIds&) const = default;
    };

    Changed changed_;
    MaterialTable materials_;
    std::vector<SceneObject> objects_;
    BakedTransforms baked_;
    std::vector<Diagnostic> left_out_;  // objects, and instances of them
    std::vector<Id<Light>> light_ids_;  // of the scene
    std::vector<Id<Node>> light_nodes_; // with lights
    std::vector<size_t> area_lights_;   // indices of objects that are meshes of area lights
    std::vector<SphereLight> spheres_;
    UsedMaterials used_;
    PartSmoothness smoothness_;                      // of parts of used_.smooth_by_texture
    bool has_colors_ = false, has_catchers_ = false; // some object
    AttributeNeeds needs_;
    ExtentCache extents_;
    Extent extent_;
    GeometryPool geometry_;
    CasterSets casters_;
    std::vector<uint32_t> masks_; // by object
    std::vector<uint32_t> sphere_masks_;
    std::vector<uint8_t> catchers_; // by part; empty: none
    LightLinks links_;
    std::vector<size_t> emissive_parts_;
    std::vector<float> area_light_spreads_; // of area_lights_, as mesh_lights_ has them
    MeshLights mesh_lights_;
    LampClearances clearances_; // of mesh_lights_
    LightTable lights_;
    GroupsOfIds grouped_;                                 // as group_of_part_ has them
    std::vector<int32_t> group_of_light_, group_of_part_; // empty: no light mix
    EnvironmentTable environment_;
    CausticCasterTable caustic_casters_;
    CausticCasterTable::Wanted wanted_casters_; // in caustic_casters_
    Accel accel_;
    SceneTables tables_;
    Features features_;
    bool has_geometry_ = false, has_environment_map_ = false;
    NeeLights aim_ = NeeLights::all_lights;                   // as passed last time
    std::array<std::string, 4> missing_light_;                // by CausticFinders
    std::shared_ptr<const std::vector<Diagnostic>> warnings_; // replaced if they change; never null after an update
};

// The camera for kernels, at the given aspect = width / height, positioned relative to `origin`.
CameraRecord camera_record(const View& view, float aspect, const Vec3d& origin);

} // namespace blush
