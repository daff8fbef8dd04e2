#include "render/compile/used_materials.h"

#include "render/lights/mesh_lights.h"
#include "render/materials/material_factors.h"
#include "render/materials/smoothness.h"

namespace blush {

std::vector<Id<Material>> material_ids_of(const std::vector<SceneObject>& objects) {
    std::set<Id<Material>> ids;
    for (const SceneObject& object : objects)
        for (const MeshPart& part : object.parts) ids.insert(part.material);
    return {ids.begin(), ids.end()};
}

UsedMaterials describe(std::vector<Id<Material>> ids, const Scene& scene, const MaterialTable& table) {
    UsedMaterials used;
    for (const Id<Material> id : ids) {
        const Material* material = scene.materials.find(id);
        used.features.bits |= features_of(material ? *material : Material{}).bits;
        used.lambertian |= may_be_lambertian(material ? *material : Material{});
        if (is_emissive(table.records[size_t(table.index_of(id))])) used.emissive.push_back(id);
        if (!material) continue;
        if (material->alpha != Material::Alpha::opaque) used.alpha.push_back(id);
        used.blends |= material->alpha == Material::Alpha::blend;
        if (is_smooth_by_texture(*material)) {
            used.smooth_by_texture.push_back(id);
        } else {
            const Smoothness smoothness = smoothness_of(*material);
            if (smoothness.casts_caustics > 0) used.casters.push_back(id);
            if (smoothness.reflects_weakly > 0) used.weak_casters.push_back(id);
        }
        used.panes |= may_pass_straight(*material);
        const TextureReads reads = texture_reads(*material);
        used.uv_sets.insert(reads.uv_sets.begin(), reads.uv_sets.end());
        used.tangents |= reads.tangents;
    }
    used.smooth = smooth_surfaces(scene, ids);
    used.ids = std::move(ids);
    return used;
}

} // namespace blush
