// The feature report matches reality: features are present or absent as reported, with the reported bytes.
#include "render/compile/feature_report.h"

#include "render/compile/expand_area_lights.h"
#include "render/compile/render_scene.h"
#include "render/film/film.h"
#include "render/lights/environment_table.h"
#include "tests/render/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace blush::test::TEST_FILE {
namespace {

struct Compiled {
    RenderSettings settings;
    RenderScene scene;
    Scene expanded;

    explicit Compiled(const Scene& s, Strategy strategy = Strategy::mis) : expanded(expand_area_lights(s)) {
        settings.strategy = strategy;
        scene.update(expanded, settings, full_plan(), Workers(1));
    }
    void change_strategy(Strategy strategy) {
        RenderSettings changed = settings;
        changed.strategy = strategy;
        scene.update(expanded, changed, plan(diff(expanded, settings, expanded, changed)), Workers(1));
        settings = changed;
    }
    FeatureReport feature_report() const { return scene.feature_report(expanded, {settings.width, settings.height, {}, false}); }
};

const FeatureUse& line(const FeatureReport& feature_report, const std::string& part, const std::string& name) {
    const auto found = std::ranges::find_if(feature_report, [&](const FeatureUse& use) { return use.part == part && use.name == name; });
    if (found == feature_report.end()) throw std::runtime_error("no line " + part + "/" + name);
    return *found;
}

Scene bare() {
    Scene scene;
    place(scene, floor_quad(1), lambert(0.5f));
    return scene;
}

// Further attributes of a quad, with normals tilted away from its plane.
GeometryPtr quad_with_attributes() {
    Geometry g = *floor_quad(1);
    g.serial = next_payload_serial();
    g.normals = {{0.1f, 1, 0}, {0, 1, 0.1f}, {0, 1, 0}, {0, 1, 0}};
    g.tangents.assign(4, {1, 0, 0, 1});
    g.uv = {g.uv[0], g.uv[0]};
    g.colors.assign(4, {1, 0.5f, 0.5f, 1});
    return std::make_shared<const Geometry>(g);
}

ImagePtr texels(int side) { return float_image(side, side, std::vector<Vec3>(size_t(side) * size_t(side), {0.5f, 0.5f, 1})); }

Scene rich() {
    Scene scene;
    Material m = plastic(0.3f);
    m.base_color_texture.texture = add_texture(scene, texels(4));
    m.normal_texture.texture = add_texture(scene, texels(8));
    m.normal_texture.uv_set = 1;
    place(scene, quad_with_attributes(), m);
    scene.environment.kind = Environment::Kind::image;
    scene.environment.image = texels(16);
    return scene;
}

TEST(FeatureReport, UnusedFeaturesOfABareSceneAreNotAllocated) {
    const Compiled c(bare());
    const SceneTables& tables = c.scene.tables();
    const FeatureReport feature_report = c.feature_report();
    for (const void* column : {tables.normals, tables.tangents, tables.uv[0], tables.uv[1], tables.colors}) EXPECT_EQ(column, nullptr);
    EXPECT_EQ(tables.environment.width, 1);
    for (const FeatureUse& use : feature_report) {
        EXPECT_EQ(use.used, use.part == "film" && use.name == "beauty") << use.part << "/" << use.name;
        EXPECT_FALSE(use.why.empty()) << use.name;
        EXPECT_FALSE(use.seconds) << use.name << ": nothing was built, so there is no time";
    }
}

TEST(FeatureReport, UsedFeaturesOfARichSceneAreAllocated) {
    const Compiled c(rich());
    const SceneTables& tables = c.scene.tables();
    const FeatureReport feature_report = c.feature_report();
    for (const void* column : {tables.normals, tables.tangents, tables.uv[0], tables.uv[1], tables.colors}) EXPECT_NE(column, nullptr);
    EXPECT_EQ(tables.environment.width, 16);
    for (const FeatureUse& use : feature_report) {
        if (use.part == "geometry" || use.part == "textures" || use.part == "lights") { EXPECT_TRUE(use.used) << use.name; }
    }
    // RGB in single precision: colour decoded, data read where they lie, mip levels of both; four vertices.
    EXPECT_EQ(line(feature_report, "textures", "texels").bytes, (4 * 4 + 4 + 1 + 16 + 4 + 1) * 12);
    EXPECT_EQ(line(feature_report, "geometry", "normals").bytes, 4 * 12);
    EXPECT_EQ(line(feature_report, "geometry", "tangents").bytes, 4 * 16);
    EXPECT_EQ(line(feature_report, "lights", "environment map").bytes, 16 * 16 * 12);
}

TEST(FeatureReport, CausticGuidingIsUsedIfMirrorsOrGlassFocusLight) {
    const char* name = "caustic guiding";
    Scene scene = bare();
    place(scene, sphere(false), glass(0, 1.5f), at({0, 1, 0}, 0.5f));
    place(scene, sphere(false), metal(0.5f), at({2, 1, 0}, 0.5f)); // too rough
    constant_world(scene, 1);
    EXPECT_FALSE(line(Compiled(scene).feature_report(), "kernel", name).used) << "a constant environment makes no caustics";
    place(scene, ceiling_quad(1, 3), emitter(1));
    const Compiled lit(scene);
    EXPECT_TRUE(line(lit.feature_report(), "kernel", name).used);
    const CausticCasterTables casters = lit.scene.tables().guides.casters;
    ASSERT_EQ(casters.count, 1);
    EXPECT_NEAR(casters.spheres[0].radius, 0.5f, 1e-4f);
    EXPECT_NEAR(casters.spheres[0].center.y, 1, 1e-6f);
}

TEST(FeatureReport, UnusedTexturesAreNotStored) {
    Scene scene = bare();
    add_texture(scene, texels(4));
    Material m = lambert(0.5f);
    m.normal_texture.texture = add_texture(scene, texels(8));
    m.normal_scale = 0; // unused
    place(scene, floor_quad(1), m);
    const Compiled c(scene);
    EXPECT_EQ(c.scene.info().textures, 0);
    EXPECT_EQ(c.scene.tables().uv[0], nullptr);
    EXPECT_EQ(c.scene.tables().tangents, nullptr);
    const FeatureReport feature_report = c.feature_report();
    EXPECT_FALSE(line(feature_report, "textures", "texels").used);
    EXPECT_EQ(line(feature_report, "textures", "unread images").bytes, (4 + 1 + 16 + 4 + 1) * 3 * 4); // mip levels
}

TEST(FeatureReport, AnEnvironmentWithoutLightHasNoMap) {
    Scene scene = rich();
    scene.environment.intensity = 0;
    Compiled c(scene);
    EXPECT_EQ(c.scene.tables().environment.width, 1);
    const FeatureUse dark = line(c.feature_report(), "lights", "importance map");
    EXPECT_FALSE(dark.used);

    UpdatePlan brighter;
    brighter.environment_parameters = brighter.lights = brighter.features = true;
    c.expanded.environment.intensity = 1;
    c.scene.update(c.expanded, c.settings, brighter, Workers(1));
    EXPECT_EQ(c.scene.tables().environment.width, 16);
    const FeatureUse bright = line(c.feature_report(), "lights", "importance map");
    EXPECT_TRUE(bright.used);
    EXPECT_EQ(bright.bytes, dark.bytes) << "bytes saved if absent equal bytes used if present";

    c.expanded.environment.intensity = 0;
    c.scene.update(c.expanded, c.settings, brighter, Workers(1));
    EXPECT_EQ(c.scene.tables().environment.width, 1) << "freed when unused";
}

TEST(FeatureReport, BsdfSamplingAloneHasNoSamplingTables) {
    Scene scene = rich();
    place(scene, floor_quad(1), emitter(2));
    Compiled c(scene, Strategy::bsdf);
    const auto expect_nothing = [&] {
        const SceneTables& tables = c.scene.tables();
        EXPECT_EQ(tables.lights.count, 0);
        EXPECT_EQ(tables.environment.rows, nullptr);
        EXPECT_EQ(tables.environment.width, 16) << "its light is still found";
        EXPECT_TRUE(c.scene.features().has(Feature::emissive_triangles) && c.scene.features().has(Feature::environment));
        const FeatureReport feature_report = c.feature_report();
        EXPECT_FALSE(line(feature_report, "lights", "light table").used);
        EXPECT_FALSE(line(feature_report, "lights", "importance map").used);
        EXPECT_TRUE(line(feature_report, "lights", "environment map").used);
    };
    expect_nothing();
    const FeatureReport without = c.feature_report();
    c.change_strategy(Strategy::mis);
    EXPECT_EQ(c.scene.tables().lights.count, 3) << "two triangles and the sky";
    EXPECT_NE(c.scene.tables().environment.rows, nullptr);
    for (const char* name : {"light table", "importance map"}) {
        const FeatureReport with = c.feature_report();
        EXPECT_TRUE(line(with, "lights", name).used) << name;
        EXPECT_EQ(line(with, "lights", name).bytes, line(without, "lights", name).bytes)
            << name << ": bytes saved if absent equal bytes used if present";
    }
    c.change_strategy(Strategy::bsdf);
    expect_nothing();

    Light point;
    point.intensity = 1;
    place_light(scene, point, at({0, 1, 0}));
    const Compiled lit(scene, Strategy::bsdf);
    EXPECT_EQ(lit.scene.tables().lights.count, 1) << "rays cannot hit a point light";
    EXPECT_FALSE(line(lit.feature_report(), "lights", "lights with a size").used);
}

TEST(FeatureReport, ClearanceBoxesAreListedIfAnEmissiveMeshMayHaveOne) {
    const char* name = "clearance boxes";
    Scene scene = bare();
    place(scene, cube(false), emitter(1), at({0, 2, 0}, 0.5f));
    EXPECT_THROW(line(Compiled(scene).feature_report(), "lights", name), std::runtime_error) << "too few triangles";
    place(scene, sphere(false), emitter(1), at({3, 0.2f, 0}, 0.5f));
    place(scene, quad({2, 0, 1}, {4, 0, 1}, {4, 0, -1}, {2, 0, -1}), lambert(0.5f));
    const FeatureUse hemmed_in = line(Compiled(scene).feature_report(), "lights", name);
    EXPECT_FALSE(hemmed_in.used);
    place(scene, sphere(false), emitter(1), at({0, 4, 0}, 0.5f));
    const FeatureUse clear = line(Compiled(scene).feature_report(), "lights", name);
    EXPECT_TRUE(clear.used);
    EXPECT_EQ(clear.why, "nothing is near 1 of 2 emissive meshes: shadow rays end before it");
    EXPECT_EQ(clear.bytes, 2 * 24);
}

TEST(FeatureReport, BytesOfTheEnvironmentAreThoseAllocated) {
    for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {64, 32}, {500, 250}}) {
        Environment e;
        e.kind = Environment::Kind::image;
        e.image = float_image(width, height, std::vector<Vec3>(size_t(width * height), {1, 2, 3}));
        const EnvironmentTable t = build_environment_table(e);
        const auto bytes = [](const auto& v) { return int64_t(v.capacity() * sizeof(v[0])); };
        const EnvironmentBytes expected = environment_bytes(width, height);
        // Those of the image, read in place.
        EXPECT_EQ(t.image, e.image);
        EXPECT_EQ(int64_t(t.image->floats.size() * sizeof(float)) + bytes(t.texels), expected.texels);
        EXPECT_EQ(bytes(t.row_thresholds) + bytes(t.column_thresholds) + bytes(t.column_guides) + bytes(t.rows), expected.importance);
    }
}

TEST(FeatureReport, BytesOfTheFilmAreThoseAllocated) {
    constexpr int width = 40, height = 30;
    for (const PlaneSet& planes :
         {PlaneSet{}, PlaneSet{.albedo = true}, PlaneSet{.depth = true}, PlaneSet{.ids = true}, PlaneSet{.bounces = 5},
          PlaneSet{.strategies = true}, PlaneSet{true, true, true, true, default_bounce_planes}})
        for (const auto& [transparent, adaptive] : {std::pair{false, false}, {true, false}, {true, true}}) {
            for (const auto& [catches, light_paths] : {std::pair{false, false}, {true, false}, {false, true}}) {
                const FilmSize size{width, height, planes, transparent, adaptive, 0, catches, light_paths};
                Film film;
                film.reset(size);
                size_t bytes = 0;
                for (const PlaneUse& plane : Film::plane_uses(size))
                    if (plane.used) bytes += plane.bytes_per_pixel * width * height;
                EXPECT_EQ(film.memory_bytes(), bytes);
            }
        }
}

// Vertices of instanced meshes are stored once, and counted once.
TEST(FeatureReport, BytesOfVertexAttributesAreThoseAllocated) {
    Scene scene = rich();
    const Id<Mesh> twice = scene.meshes.add({"", {{quad_with_attributes(), scene.materials.add(lambert(0.5f))}}});
    for (const float x : {-3.f, 3.f}) {
        Node node;
        node.mesh = twice;
        node.local = at({x, 0, 0});
        scene.nodes.add(node);
    }
    GeometryPool pool;
    pool.build(list_objects(scene), {.tangents = true, .colors = true, .uv_sets = {0, 1}}, {0, 0, 0});
    GeometryPool less;
    less.build(list_objects(scene), {}, {0, 0, 0});
    EXPECT_EQ(pool.vertex_count(), less.vertex_count());
    EXPECT_EQ(int64_t(pool.memory_bytes() - less.memory_bytes()), pool.vertex_count() * (8 + 8 + 16 + 16));
}

TEST(FeatureReport, CostsAreFormattedWithUnits) {
    EXPECT_EQ(cost_text({"film", "depth", false, "", 3 << 20}), "saves 3.00 MiB");
    EXPECT_EQ(cost_text({"film", "depth", true, "", 512, 0.0125}), "0.50 KiB, 12.5 ms");
    EXPECT_EQ(cost_text({"textures", "texels", false, "", 0}), "saves nothing");
    EXPECT_EQ(cost_text({"kernel", "suns", false, ""}), "not measured");
    EXPECT_EQ(cost_text({"kernel", "suns", true, ""}), "");
}

} // namespace
} // namespace blush::test::TEST_FILE
