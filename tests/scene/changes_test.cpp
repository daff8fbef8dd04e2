// diff(before, after): each kind of edit gives exactly its row of the table.
#include "scene/changes.h"
#include "tests/support/random_edits.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace blush::TEST_FILE {
namespace {

using test::Sample;
using test::sample_project;

// A comparable copy: gtest prints which part differs.
struct Seen {
    bool view, resolution, integrator, stop_rules, environment_parameters, environment_image, motion;
    std::vector<Id<Node>> transforms, moved_meshes, structure;
    std::vector<Id<Mesh>> meshes;
    std::vector<Id<Material>> materials;
    std::vector<Id<Texture>> textures;
    std::vector<Id<Light>> lights;
    bool operator==(const Seen&) const = default;
};

Seen seen(const Changes& c) {
    return {c.view,
            c.resolution,
            c.integrator,
            c.stop_rules,
            c.environment_parameters,
            c.environment_image,
            c.motion,
            c.transforms,
            c.moved_meshes,
            c.structure,
            c.meshes,
            c.materials,
            c.textures,
            c.lights};
}

void PrintTo(const Seen& s, std::ostream* out) {
    *out << (s.view ? "view " : "") << (s.resolution ? "resolution " : "") << (s.integrator ? "integrator " : "")
         << (s.stop_rules ? "stop_rules " : "") << (s.environment_parameters ? "environment_parameters " : "")
         << (s.environment_image ? "environment_image " : "") << (s.motion ? "motion " : "") << s.transforms.size() << " transforms "
         << s.moved_meshes.size() << " moved meshes " << s.structure.size() << " structure " << s.meshes.size() << " meshes "
         << s.materials.size() << " materials " << s.textures.size() << " textures " << s.lights.size() << " lights";
}

Changes diff(const Project& a, const Project& b) { return blush::diff(a.scene, a.render, b.scene, b.render); }

// Changes of the sample project by `edit`.
Changes changes_of(const Sample& s, const Edit& edit) {
    const Result<Project> after = blush::apply(s.project, edit);
    EXPECT_TRUE(after) << after.error().text();
    return after ? diff(s.project, *after) : Changes{};
}

Node changed(const Sample& s, Id<Node> id, auto&& with) {
    Node node = *s.project.scene.nodes.find(id);
    with(node);
    return node;
}

// The row of the table: Changes with only what `fill` sets.
Seen only(auto&& fill) {
    Changes c;
    fill(c);
    return seen(c);
}
const Seen nothing = seen(Changes{});

TEST(Diff, EqualProjectsDifferInNothing) {
    const Sample s = sample_project();
    const Changes none = diff(s.project, s.project);
    EXPECT_EQ(seen(none), nothing);
    EXPECT_FALSE(none.any());
    EXPECT_FALSE(none.affects_image());
}

TEST(Diff, NodeEdits) {
    const Sample s = sample_project();
    const auto of = [&](auto&& with) { return seen(changes_of(s, SetNode{s.mug, changed(s, s.mug, with)})); };
    const Seen transform = only([&](Changes& c) { c.transforms = c.moved_meshes = {s.mug}; });
    const Seen structure = only([&](Changes& c) { c.structure = {s.mug}; });
    EXPECT_EQ(of([](Node& n) { n.name = "Cup"; }), nothing);
    EXPECT_EQ(of([](Node& n) { n.local.translation.x += 1; }), transform);
    EXPECT_EQ(of([](Node& n) { n.local.matrix = Affine{}; }), transform);
    EXPECT_EQ(of([&](Node& n) { n.parent = s.table; }), transform);
    EXPECT_EQ(of([](Node& n) { n.visible = false; }), structure);
    EXPECT_EQ(of([](Node& n) { n.mesh = {}; }), structure);
    EXPECT_EQ(of([&](Node& n) { n.light = s.lamp; }), structure);
    EXPECT_EQ(of([&](Node& n) { n.camera = s.camera; }), nothing);
    EXPECT_EQ(of([](Node& n) { n.morph_weights = {1}; }), structure);
}

TEST(Diff, SceneSelectionEdits) {
    Sample s = sample_project();
    const auto of = [&](const SceneSelection& scene_selection) { return seen(changes_of(s, SetSceneSelection{scene_selection})); };
    const Seen motion = only([](Changes& c) { c.motion = true; });
    EXPECT_EQ(of({.clip = s.swing}), motion);
    EXPECT_EQ(of({.seconds = 1}), nothing) << "of no clip";
    EXPECT_EQ(of({.variant = 0}), nothing) << "has the same material";
    EXPECT_EQ(of({.variant = 1}), only([&](Changes& c) { c.meshes = {s.quad}; }));
    s.project.scene.scene_selection = {.clip = s.swing, .seconds = 1};
    EXPECT_EQ(of({.clip = s.swing, .seconds = 1.5f}), motion);
    EXPECT_EQ(of({}), motion);
    EXPECT_EQ(of({.clip = s.swing, .seconds = 1}), nothing);
    EXPECT_FALSE(changes_of(s, SetSceneSelection{{}}).only_light());
}

TEST(Diff, ReparentingBelowAHiddenNodeHidesIt) {
    Sample s = sample_project();
    s.project = *blush::apply(s.project, SetNode{s.table, changed(s, s.table, [](Node& n) { n.visible = false; })});
    EXPECT_EQ(seen(changes_of(s, SetNode{s.mug, changed(s, s.mug, [&](Node& n) { n.parent = s.table; })})), only([&](Changes& c) {
                  c.transforms = c.moved_meshes = {s.mug};
                  c.structure = {s.mug};
              }));
}

TEST(Diff, AddedAndRemovedBranches) {
    const Sample s = sample_project();
    EXPECT_EQ(seen(changes_of(s, RemoveNode{s.root})), only([&](Changes& c) { c.structure = {s.root, s.mug, s.lamp_node}; }));
    const Changes duplicate = changes_of(s, DuplicateNode{s.root});
    EXPECT_EQ(duplicate.structure.size(), 3u);
    EXPECT_EQ(duplicate.lights.size(), 1u);
    EXPECT_TRUE(duplicate.meshes.empty());
    const Changes light = changes_of(s, AddLight{Node{}, Light{}});
    EXPECT_EQ(light.structure.size(), 1u);
    EXPECT_EQ(light.lights.size(), 1u);
    const Changes import = changes_of(s, Import{s.project.scene, "again"});
    EXPECT_EQ(import.structure.size(), s.project.scene.nodes.size());
    EXPECT_EQ(import.meshes.size(), 1u);
    EXPECT_EQ(import.materials.size(), 2u);
    EXPECT_EQ(import.textures.size(), 1u);
    EXPECT_EQ(import.lights.size(), 1u);
}

TEST(Diff, RecordEdits) {
    const Sample s = sample_project();
    Material red = *s.project.scene.materials.find(s.red);
    red.name = "Crimson";
    EXPECT_EQ(seen(changes_of(s, SetMaterial{s.red, red})), nothing);
    red.roughness = 0.25f;
    EXPECT_EQ(seen(changes_of(s, SetMaterial{s.red, red})), only([&](Changes& c) { c.materials = {s.red}; }));

    Light lamp = *s.project.scene.lights.find(s.lamp);
    lamp.name = "Key";
    EXPECT_EQ(seen(changes_of(s, SetLight{s.lamp, lamp})), nothing);
    lamp.enabled = false;
    EXPECT_EQ(seen(changes_of(s, SetLight{s.lamp, lamp})), only([&](Changes& c) { c.lights = {s.lamp}; }));

    Texture checker = *s.project.scene.textures.find(s.checker);
    checker.source = "checker.png";
    EXPECT_EQ(seen(changes_of(s, SetTexture{s.checker, checker})), nothing);
    checker.wrap_v = Texture::Wrap::clamp_to_edge;
    EXPECT_EQ(seen(changes_of(s, SetTexture{s.checker, checker})), only([&](Changes& c) { c.textures = {s.checker}; }));

    EXPECT_EQ(seen(changes_of(s, AssignMaterial{s.quad, 0, s.grey})), only([&](Changes& c) { c.meshes = {s.quad}; }));
    EXPECT_EQ(seen(changes_of(s, SetCamera{s.camera, {"Other", {.yfov_radians = 1}}})), nothing);
}

TEST(Diff, PayloadsAreComparedBySerial) {
    const Sample s = sample_project();
    Project after = s.project;
    Texture checker = *after.scene.textures.find(s.checker);
    checker.image = std::make_shared<const Image>(*checker.image); // another owner of the same data
    after.scene.textures.set(s.checker, checker);
    Mesh quad = *after.scene.meshes.find(s.quad);
    quad.parts[0].geometry = std::make_shared<const Geometry>(*quad.parts[0].geometry);
    after.scene.meshes.set(s.quad, quad);
    EXPECT_EQ(seen(diff(s.project, after)), nothing);
    quad.parts[0].geometry = test::quad_geometry(); // equal content, which is not compared
    after.scene.meshes.set(s.quad, quad);
    EXPECT_EQ(seen(diff(s.project, after)), only([&](Changes& c) { c.meshes = {s.quad}; }));
}

TEST(Diff, EnvironmentEdits) {
    const Sample s = sample_project();
    const auto of = [&](auto&& with) {
        Environment e = s.project.scene.environment;
        with(e);
        return seen(changes_of(s, SetEnvironment{e}));
    };
    const Seen parameters = only([](Changes& c) { c.environment_parameters = true; });
    const Seen image = only([](Changes& c) { c.environment_image = true; });
    EXPECT_EQ(of([](Environment& e) { e.intensity = 2; }), parameters);
    EXPECT_EQ(of([](Environment& e) { e.color.x = 2; }), parameters);
    EXPECT_EQ(of([](Environment& e) { e.rotation_degrees = 2; }), parameters);
    EXPECT_EQ(of([](Environment& e) { e.visible_to_camera = false; }), parameters);
    EXPECT_EQ(of([](Environment& e) { e.kind = Environment::Kind::none; }), image);
    EXPECT_EQ(of([](Environment& e) { e.kind = Environment::Kind::image, e.image = test::uniform_image(2, 1, 3, 1); }), image);
    EXPECT_EQ(of([](Environment& e) { e.file = "elsewhere.hdr"; }), nothing);
}

TEST(Diff, ViewAndSettings) {
    const Sample s = sample_project();
    EXPECT_EQ(seen(changes_of(s, SetLens{{.yfov_radians = 1}})), only([](Changes& c) { c.view = true; }));
    Project moved = s.project;
    moved.scene.view.pivot_distance += 1;
    EXPECT_EQ(seen(diff(s.project, moved)), nothing);
    moved.scene.view.position.x += 1;
    EXPECT_EQ(seen(diff(s.project, moved)), only([](Changes& c) { c.view = true; }));

    // The focus distance has no effect on a pinhole.
    for (const float aperture : {0.f, 0.01f}) {
        Project near = s.project;
        near.scene.view.lens.aperture_radius = aperture;
        Project far = near;
        far.scene.view.lens.focus_distance += 1;
        EXPECT_EQ(seen(diff(near, far)), aperture > 0 ? only([](Changes& c) { c.view = true; }) : nothing) << aperture;
    }

    const auto of = [&](auto&& with) {
        RenderSettings r = s.project.render;
        with(r);
        return changes_of(s, SetRender{r});
    };
    const Seen integrator = only([](Changes& c) { c.integrator = true; });
    const Seen resolution = only([](Changes& c) { c.resolution = true; });
    const Seen stop_rules = only([](Changes& c) { c.stop_rules = true; });
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.max_bounces = 2; })), integrator);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.roulette.start = 1; })), integrator);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.strategy = Strategy::bsdf; })), integrator);
    EXPECT_TRUE(of([](RenderSettings& r) { r.strategy = Strategy::bsdf; }).nee_changed);
    EXPECT_FALSE(of([](RenderSettings& r) { r.strategy = Strategy::light; }).nee_changed);
    EXPECT_TRUE(of([](RenderSettings& r) { r.mis_compensation = true; }).nee_changed);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.heuristic.exponent = 1; })), integrator);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.filter = PixelFilter::box; })), integrator);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.sampler = SamplerType::random; })), integrator);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.seed = 1; })), integrator);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.first_sample = 1; })), integrator);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.energy_compensation = true; })), integrator);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.adaptive = true; })), integrator);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.reuse = 8; })), integrator);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.clamp.limit = 3; })), integrator);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.width = 640; })), resolution);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.height = 640; })), resolution);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.resolution_scale = 0.5f; })), resolution);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.spp = 128; })), stop_rules);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.seconds = 1; })), stop_rules);
    EXPECT_EQ(seen(of([](RenderSettings& r) { r.error = 0.1; })), stop_rules);
    const Changes stop = of([](RenderSettings& r) { r.spp = 128; });
    EXPECT_TRUE(stop.any());
    EXPECT_FALSE(stop.affects_image());
    EXPECT_EQ(seen(changes_of(s, SetView{{.exposure_ev = 1}})), nothing);
}

// diff is symmetric: it reports the same ids in both directions.
TEST(Diff, IsSymmetric) {
    test::Rng rng(3);
    Project project = sample_project().project;
    for (int i = 0; i < 300; ++i) {
        const Project next = *blush::apply(project, test::random_edit(rng, project));
        EXPECT_EQ(seen(diff(project, next)), seen(diff(next, project)));
        project = next;
    }
}

} // namespace
} // namespace blush::TEST_FILE
