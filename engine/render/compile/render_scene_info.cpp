// Statistics of a compiled scene, for `blush info`.
#include "render/compile/render_scene.h"
#include "render/lights/light_limits.h"

#include <fmt/format.h>

namespace blush {
namespace {

std::string counted(int64_t n, const char* one, const char* many) { return fmt::format("{} {}", n, n == 1 ? one : many); }

} // namespace

void RenderScene::update_warnings() {
    std::vector<Diagnostic> warnings = materials_.textures.warnings;
    warnings.insert(warnings.end(), materials_.warnings.begin(), materials_.warnings.end());
    warnings.insert(warnings.end(), environment_.warnings.begin(), environment_.warnings.end());
    warnings.insert(warnings.end(), left_out_.begin(), left_out_.end());
    if (casters_.left_out() > 0)
        warnings.push_back({Diagnostic::Severity::warning,
                            fmt::format("more than {} different sets of shadow casters: shadow linking is ignored for {}", max_caster_sets,
                                        counted(casters_.left_out(), "light", "lights")),
                            ""});
    if (lights_.unsampled_triangles > 0)
        warnings.push_back({Diagnostic::Severity::warning,
                            fmt::format("{} of {} emissive triangles exceed the light-sampling limit of {}: their light is found by BSDF "
                                        "sampling only and will be noisy",
                                        lights_.unsampled_triangles, lights_.emissive_triangles, max_mesh_lights),
                            ""});
    if (lights_.fewer_disk_corners > 0)
        warnings.push_back({Diagnostic::Severity::warning,
                            fmt::format("many disk lights: each is a polygon of {} corners instead of {}, which is visible at their "
                                        "edges and in reflections",
                                        lights_.fewer_disk_corners, max_disk_corners),
                            ""});
    if (!warnings_ || *warnings_ != warnings) warnings_ = std::make_shared<const std::vector<Diagnostic>>(std::move(warnings));
}

CasterSphere RenderScene::bounding_sphere() const {
    const Bounds& box = extent_.bounds;
    if (box.empty) return {};
    return {to_float(box.center() - extent_.origin), float(box.radius() * (1 + 1e-5))}; // enlarged against rounding
}

bool RenderScene::camera_sees_emission() const {
    const auto seen = [](uint32_t mask) { return (mask & camera_ray_mask) != 0; };
    const auto emits = [&](const MeshPart& part) { return std::ranges::find(used_.emissive, part.material) != used_.emissive.end(); };
    for (size_t i = 0; i < objects_.size(); ++i)
        if (seen(masks_[i]) && std::ranges::any_of(objects_[i].parts, emits)) return true;
    return features_.has(Feature::unlit) || std::ranges::any_of(sphere_masks_, seen) ||
           std::ranges::any_of(lights_.suns, [&](int32_t sun) { return !(lights_.records[size_t(sun)].flags & light_hidden); }) ||
           (has_environment_map_ && tables_.environment.visible_to_camera);
}

CompiledInfo RenderScene::info() const {
    CompiledInfo info;
    info.materials = int64_t(materials_.ids.size());
    info.textures = int64_t(materials_.textures.records.size());
    if (warnings_) info.warnings = *warnings_;
    info.environment = lights_.environment >= 0;
    info.emissive_triangles = lights_.emissive_triangles;
    info.point_lights = lights_.point_lights;
    info.suns = lights_.sun_lights;
    if (has_geometry_) {
        info.meshes = int64_t(geometry_.parts().size());
        info.instances = geometry_.instance_count();
        for (size_t part = 0; part < geometry_.parts().size(); ++part) info.triangles += geometry_.triangle_count(part);
        for (const size_t i : area_lights_) {
            if (!objects_[i].disabled) continue;
            info.meshes -= int64_t(objects_[i].copies() * objects_[i].parts.size());
            info.instances -= objects_[i].instanced ? int64_t(objects_[i].copies()) : 0;
            info.triangles -= int64_t(objects_[i].copies() * objects_[i].triangle_count());
        }
    }
    const size_t bytes = geometry_.memory_bytes() + accel_.memory_bytes() + materials_.textures.memory_bytes() +
                         environment_.texels.capacity() * 4 + environment_.column_thresholds.capacity() * 4 +
                         environment_.column_guides.capacity() * sizeof(environment_.column_guides[0]) +
                         lights_.records.capacity() * sizeof(LightRecord) + lights_.profiles.memory_bytes() + lights_.tree.memory_bytes();
    info.memory_mb = double(bytes) / 1e6;
    return info;
}

} // namespace blush
