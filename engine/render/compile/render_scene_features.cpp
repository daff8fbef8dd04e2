// Lines of the feature report of a compiled scene.
#include "render/compile/render_scene.h"

#include "render/bvh/small_scene.h"
#include "render/film/film.h"
#include "render/lights/light_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace blush {
namespace {

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
    {Feature::point_lights, "point lights", "the scene has points or spots of zero size", "the scene has no points or spots of zero size"},
    {Feature::sphere_lights, "sphere lights", "the scene has sphere lights", "the scene has no sphere lights"},
    {Feature::light_profiles, "light profiles", "a light has an IES profile or a spread", "no light has an IES profile or a spread"},
    {Feature::light_tree, "light tree", "the scene has several lights", "the scene has one light at most"},
    {Feature::suns, "suns", "the scene has a sun", "the scene has no sun"},
    {Feature::environment, "environment", "the scene has an environment", "the scene has no environment"},
    {Feature::instances, "instances", "a mesh is shared or large", "every mesh is small and used once"},
    {Feature::links, "light links", "a light is linked to objects", "no light is linked to objects"},
    {Feature::energy_compensation, "energy compensation", "switched on", "switched off"},
    {Feature::thin_lens, "depth of field", "the lens has an aperture", "the camera is a pinhole"},
    {Feature::clearcoat, "clear coats", "a material has a clear coat", "no material has a clear coat"},
    {Feature::sheen, "sheen", "a material has a sheen", "no material has a sheen"},
    {Feature::anisotropy, "anisotropy", "a material has anisotropic reflections", "no material has anisotropic reflections"},
    {Feature::iridescence, "iridescence", "a material has a thin film", "no material has a thin film"},
    {Feature::diffuse_transmission, "translucency", "a material transmits light diffusely", "no material transmits light diffusely"},
    {Feature::dispersion, "dispersion", "a solid has dispersion", "no solid has dispersion"},
    {Feature::orthographic, "orthographic camera", "the camera is orthographic", "the camera is not orthographic"},
};

void add_kernel(FeatureReport& feature_report, Features features) {
    for (const FeatureText& t : feature_texts) {
        const bool used = features.has(t.feature);
        feature_report.push_back({"kernel", t.name, used, used ? t.used : t.unused});
    }
}

void add_film(FeatureReport& feature_report, const FilmSize& film) {
    for (const PlaneUse& p : Film::plane_uses(film))
        feature_report.push_back({"film", p.name, p.used, p.why, int64_t(p.bytes_per_pixel) * film.width * film.height});
}

void add_vertices(FeatureReport& feature_report, const GeometryPool& geometry, const AttributeNeeds& needs) {
    struct Attribute {
        const char* name;
        bool used;
        const char *why_used, *why_not;
        size_t bytes;
    };
    const size_t uv_sets = needs.uv_sets.size() - size_t(std::ranges::count(needs.uv_sets, -1));
    const Attribute attributes[] = {
        {"normals", geometry.has_normals(), "a mesh is smooth", "every mesh is flat", sizeof(Vec3)},
        {"texture coordinates", uv_sets > 0, uv_sets > 1 ? "textures use several UV sets" : "a texture uses them", "no texture uses them",
         std::max<size_t>(1, uv_sets) * sizeof(Vec2)},
        {"tangents", needs.tangents, "a material has a normal map", "no material has a normal map", sizeof(Vec4)},
        {"vertex colours", needs.colors, "a mesh has them", "no mesh has them", sizeof(Vec4)},
    };
    for (const Attribute& a : attributes)
        feature_report.push_back({"geometry", a.name, a.used, a.used ? a.why_used : a.why_not, int64_t(a.bytes) * geometry.vertex_count()});
    if (const size_t n = geometry.shapes_in_place(); n > 0)
        feature_report.push_back(
            {"geometry", "copies of large shapes", false,
             n == 1 ? "it is read in place from the document" : fmt::format("{} are read in place from the document", n),
             int64_t(geometry.in_place_bytes())});
}

void add_tracer(FeatureReport& feature_report, const SmallScene* small) {
    if (!small) return;
    feature_report.push_back(
        {"geometry", "BVH", false, fmt::format("{} faces in a closed room: testing all of them is faster", small->faces.size())});
}

// Only meshes with a bottom-level BVH of their own are candidates.
void add_trees(FeatureReport& feature_report, size_t instanced_meshes_triangles, size_t compact_triangles) {
    if (instanced_meshes_triangles == 0) return;
    constexpr int64_t bytes_per_triangle = 27;
    if (compact_triangles == 0)
        return feature_report.push_back({"geometry", "BVH stores vertices", true, "memory suffices, and tracing is faster"});
    feature_report.push_back({"geometry", "BVH stores vertices", false,
                              fmt::format("memory is short for {} triangles: tracing takes 1.24 times as long", compact_triangles),
                              bytes_per_triangle * int64_t(compact_triangles)});
}

void add_textures(FeatureReport& feature_report, const TextureTable& table, const Scene& scene) {
    std::set<uint64_t> read, unread; // images by serial
    for (const TextureSource& source : table.sources) read.insert(source.image->serial);
    int64_t unread_bytes = 0;
    for (const auto& [id, texture] : scene.textures) {
        if (!texture.image || read.contains(texture.image->serial) || !unread.insert(texture.image->serial).second) continue;
        unread_bytes += texel_bytes(*texture.image);
    }
    const bool used = !read.empty();
    const int64_t bytes = int64_t(table.memory_bytes());
    FeatureUse texels{
        "textures", "texels", used,
        used ? fmt::format("materials read {} image{}", read.size(), read.size() == 1 ? "" : "s") : "no material reads an image", bytes};
    if (used) texels.seconds = table.seconds;
    feature_report.push_back(texels);
    if (!unread.empty())
        feature_report.push_back({"textures", "unread images", false,
                                  fmt::format("{} of the scene are read by no material in use", unread.size()), unread_bytes});
}

// The reason why the environment has no map.
const char* why_no_map(const Environment& e) {
    if (e.kind == Environment::Kind::none) return "the scene has no environment";
    if (e.kind == Environment::Kind::constant) return "the environment is one colour";
    return gives_light(e) ? "the image cannot be used" : "the environment gives no light";
}

constexpr const char* bsdf_sampling_only = "the strategy is BSDF sampling alone";
constexpr const char* even_environment = "the environment is even: BSDF sampling finds its light (MIS compensation)";

void add_light_table(FeatureReport& feature_report, const LightTable& lights, NeeLights aim) {
    const int64_t triangles = lights.emissive_triangles - lights.unsampled_triangles;
    const int64_t all = triangles + lights.point_lights + lights.sphere_lights + lights.sun_lights + (lights.environment >= 0);
    const bool used = lights.count > 0;
    feature_report.push_back({"lights", "light table", used,
                              used                           ? "the scene has lights"
                              : all == 0                     ? "nothing emits light"
                              : aim == NeeLights::all_lights ? even_environment
                                                             : bsdf_sampling_only,
                              light_table_bytes(used && lights.tree.empty() ? lights.count : all)});
    if (!lights.tree.empty())
        feature_report.push_back({"lights", "light tree", true, "the scene has several lights", int64_t(lights.tree.memory_bytes())});
    if (lights.unsampled_triangles > 0)
        feature_report.push_back({"lights", "mesh lights beyond the limit", false,
                                  fmt::format("no more than {} triangles are sampled", max_mesh_lights),
                                  light_table_bytes(lights.unsampled_triangles)});
    if (aim == NeeLights::zero_size_lights && used && all > lights.count)
        feature_report.push_back({"lights", "lights with a size", false, bsdf_sampling_only, light_table_bytes(all - lights.count)});
}

// Only emissive meshes of many triangles on their convex hull are candidates.
void add_clearances(FeatureReport& feature_report, const LampClearances& clearances) {
    const size_t all = clearances.lamps(), clear = clearances.clear_lamps();
    if (all == 0) return;
    FeatureUse boxes{"lights", "clearance boxes", clear > 0, "other objects are near the emissive meshes: shadow rays enter their BVH"};
    if (clear > 0) {
        boxes.why =
            fmt::format("nothing is near {} of {} emissive meshes: shadow rays end before {}", clear, all, clear == 1 ? "it" : "them");
        boxes.bytes = int64_t(all * sizeof(ClearanceBox));
    }
    feature_report.push_back(boxes);
}

void add_lights(FeatureReport& feature_report, const LightTable& lights, const EnvironmentTable& environment, const Environment& e,
                NeeLights aim) {
    add_light_table(feature_report, lights, aim);

    const bool is_sky = e.kind == Environment::Kind::sky;
    const bool used =
        (is_sky || e.kind == Environment::Kind::image) && gives_light(e) && int64_t(environment.width) * environment.height > 1;
    FeatureUse map{"lights", "environment map", used,
                   !used    ? why_no_map(e)
                   : is_sky ? "the environment is a sky"
                            : "the environment is an image",
                   0};
    const bool is_sampled = used && aim == NeeLights::all_lights && environment.sampled_share > 0;
    FeatureUse importance{"lights", "importance map", is_sampled,
                          is_sampled                     ? "the environment is sampled as a light"
                          : !used                        ? why_no_map(e)
                          : aim == NeeLights::all_lights ? even_environment
                                                         : bsdf_sampling_only,
                          0};
    if (is_sky || (e.kind == Environment::Kind::image && e.image)) {
        const EnvironmentBytes bytes =
            is_sky ? environment_bytes(sky_map_width, sky_map_height) : environment_bytes(e.image->width, e.image->height);
        map.bytes = bytes.texels;
        importance.bytes = bytes.importance;
    }
    if (is_sampled) importance.seconds = environment.seconds;
    feature_report.push_back(map);
    feature_report.push_back(importance);
}

} // namespace

FeatureReport RenderScene::feature_report(const Scene& expanded, const FilmSize& film) const {
    FeatureReport feature_report;
    add_kernel(feature_report, features_);
    const int32_t casters = tables_.guides.casters.count;
    feature_report.push_back({"kernel", "caustic guiding", casters > 0,
                              casters > 0 ? fmt::format("mirrors or glass in {} place{}", casters, casters == 1 ? "" : "s")
                                          : why_no_guides(tables_.guides.casters, tables_.emission_casters)});
    add_film(feature_report, film);
    add_vertices(feature_report, geometry_, needs_);
    add_tracer(feature_report, accel_.small_scene());
    add_trees(feature_report, geometry_.largest_instanced_mesh(), accel_.compact_triangles());
    add_textures(feature_report, materials_.textures, expanded);
    add_lights(feature_report, lights_, environment_, expanded.environment, aim_);
    add_clearances(feature_report, clearances_);
    return feature_report;
}

} // namespace blush
