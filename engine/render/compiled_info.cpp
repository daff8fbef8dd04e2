// What a compiled scene is made of, what it needs of a kernel, and why: for `blush info` and the Render panel.
#include "render/render_scene.h"

#include <fmt/format.h>

namespace blush {
namespace {

std::string counted(int64_t n, const char* one, const char* many) { return fmt::format("{} {}", n, n == 1 ? one : many); }

struct FeatureText {
    Feature feature;
    const char* name;
    const char* used;
    const char* unused;
};

constexpr FeatureText feature_texts[] = {
    {Feature::specular, "specular", "a material has a GGX reflection", "all materials are Lambertian"},
    {Feature::transmission, "transmission", "a material transmits light", "no material transmits light"},
    {Feature::absorption, "absorption", "a solid absorbs light inside", "no solid absorbs light inside"},
    {Feature::textures, "textures", "a material reads a texture", "no material reads a texture"},
    {Feature::normal_maps, "normal maps", "a material has a normal map", "no material has a normal map"},
    {Feature::vertex_colors, "vertex colours", "a mesh has vertex colours", "no mesh has vertex colours"},
    {Feature::unlit, "unlit", "a material is unlit", "no material is unlit"},
    {Feature::emissive_triangles, "mesh lights", "a mesh emits light", "no mesh emits light"},
    {Feature::point_lights, "point lights", "the scene has points or spots without size", "the scene has no points or spots without size"},
    {Feature::suns, "suns", "the scene has a sun", "the scene has no sun"},
    {Feature::environment, "environment", "the scene has an environment", "the scene has no environment"},
    {Feature::instances, "instances", "a mesh is shared or large", "every mesh is small and used once"},
    {Feature::energy_compensation, "energy compensation", "switched on", "switched off"},
    {Feature::thin_lens, "depth of field", "the lens has an aperture", "the camera is a pinhole"},
    {Feature::orthographic, "orthographic camera", "the camera is orthographic", "the camera is not orthographic"},
};

Diagnostic degenerate_triangles(int64_t n) {
    return {Diagnostic::Severity::warning, counted(n, "triangle has no area and cannot be seen", "triangles have no area and cannot be seen"), ""};
}

} // namespace

CompiledInfo RenderScene::info() const {
    CompiledInfo info;
    info.materials = int64_t(materials_.ids.size());
    info.textures = int64_t(materials_.textures.records.size());
    info.warnings = materials_.textures.warnings;
    info.warnings.insert(info.warnings.end(), environment_.warnings.begin(), environment_.warnings.end());
    info.environment = lights_.environment >= 0;
    info.emissive_triangles = lights_.emissive_triangles;
    info.point_lights = lights_.point_lights;
    info.suns = lights_.sun_lights;
    if (has_geometry_) {
        info.meshes = int64_t(geometry_.parts().size());
        info.instances = geometry_.instance_count();
        int64_t degenerate = 0;
        for (size_t part = 0; part < geometry_.parts().size(); ++part) info.triangles += geometry_.triangle_count(part);
        for (size_t part = 0; part < geometry_.parts().size(); ++part) degenerate += geometry_.degenerate_count(part);
        if (degenerate > 0) info.warnings.push_back(degenerate_triangles(degenerate));
    }
    for (const FeatureText& t : feature_texts) {
        const bool used = features_.has(t.feature);
        info.features.push_back({t.name, used, used ? t.used : t.unused});
    }
    const size_t bytes = geometry_.memory_bytes() + accel_.memory_bytes() + materials_.textures.rgba8.capacity() * 4 +
                         materials_.textures.rgba32f.capacity() * 4 + environment_.texels.capacity() * 4 +
                         environment_.column_thresholds.capacity() * 4 + environment_.column_guides.capacity() * sizeof(environment_.column_guides[0]) +
                         lights_.records.capacity() * sizeof(LightRecord);
    info.memory_mb = double(bytes) / 1e6;
    return info;
}

} // namespace blush
