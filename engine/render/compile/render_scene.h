// The compiled scene: tables that kernels read, kept up to date with the edited scene. Only this file knows both.
#pragma once

#include "core/parallel.h"
#include "render/bvh/accel.h"
#include "render/compile/baked_transforms.h"
#include "render/compile/compiled_info.h"
#include "render/compile/feature_report.h"
#include "render/compile/geometry_pool.h"
#include "render/compile/object_list.h"
#include "render/compile/scene_origin.h"
#include "render/compile/update_plan.h"
#include "render/film/film_size.h"
#include "render/kernels/kernel.h"
#include "render/light_mix/light_groups.h"
#include "render/lights/caustic_caster_table.h"
#include "render/lights/environment_table.h"
#include "render/lights/light_links.h"
#include "render/lights/light_table.h"
#include "render/materials/material_table.h"

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
    // Inverse of material_id(); 0 for an unknown id.
    int32_t material_index(Id<Material> id) const { return materials_.index_of(id); }
    // By part: 1 if the part is a shadow catcher (shadow_catcher.h); empty: no shadow catchers.
    const std::vector<uint8_t>& catchers() const { return catchers_; }
    // True if NEE or rays can find light.
    bool has_light() const { return lights_.count > 0 || lights_.emissive_triangles > 0 || lights_.environment >= 0; }
    // See missing_light.h.
    const std::string& missing_light() const { return missing_light_; }
    // Everything except the kernel and the feature report.
    CompiledInfo info() const;
    // `lowered` as passed last time; the film that is rendered to.
    FeatureReport feature_report(const Scene& expanded, const FilmSize& film) const;

private:
    void update_materials(const Scene& scene, const UpdatePlan& plan, const Workers& workers);
    void update_geometry(const Scene& scene, const UpdatePlan& plan, const Workers& workers);
    AccelScene accel_scene(const Scene& expanded) const;
    void update_lights(const Scene& scene, const RenderSettings& settings, const UpdatePlan& plan, const LightGroups* groups);
    void update_groups(const LightGroups& groups);
    void update_caustic_casters(const Scene& scene, const RenderSettings& settings);
    Features compute_features(const Scene& scene, const RenderSettings& settings) const;

    MaterialTable materials_;
    std::vector<SceneObject> objects_;
    BakedTransforms baked_;
    std::vector<Diagnostic> left_out_; // objects, and instances of them
    std::vector<SphereLight> spheres_;
    AttributeNeeds needs_;
    ExtentCache extents_;
    Extent extent_;
    GeometryPool geometry_;
    std::vector<bool> alpha_; // by part
    CasterSets casters_;
    std::vector<uint32_t> masks_;   // by object
    std::vector<uint8_t> catchers_; // by part; empty: none
    LightLinks links_;
    LightTable lights_;
    std::vector<int32_t> group_of_light_, group_of_part_; // empty: no light mix
    EnvironmentTable environment_;
    CausticCasterTable caustic_casters_;
    Accel accel_;
    SceneTables tables_;
    Features features_;
    bool has_geometry_ = false, has_environment_map_ = false;
    NeeLights aim_ = NeeLights::all_lights; // as passed last time
    std::string missing_light_;
};

// The camera for kernels, at the given aspect = width / height, positioned relative to `origin`.
CameraRecord camera_record(const View& view, float aspect, const Vec3d& origin);

} // namespace blush
