// The update policy, row by row: the updates needed for each change, and so for each kind of edit.
#include "render/compile/update_plan.h"

#include "render/compile/expand_area_lights.h"
#include "render/compile/expanded_lights.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <ostream>

namespace blush::TEST_FILE {

void PrintTo(const UpdatePlan& p, std::ostream* out) {
    const auto say = [&](bool set, const char* name) { *out << (set ? name : ""); };
    say(p.objects, "objects ");
    say(p.transforms, "transforms ");
    say(p.all_materials, "all_materials ");
    say(p.lights, "lights ");
    say(p.environment_map, "environment_map ");
    say(p.environment_parameters, "environment_parameters ");
    say(p.camera, "camera ");
    say(p.clear_film, "clear_film ");
    say(p.features, "features ");
    for (const Id<Node> id : p.moved_area_lights) *out << "area light " << id.value << " ";
    for (const Id<Material> id : p.materials) *out << "material " << id.value << " ";
}

namespace {

using test::Sample;
using test::sample_project;

// Updates that always occur together.
UpdatePlan nothing() { return {}; }
UpdatePlan camera() {
    UpdatePlan p;
    p.camera = p.clear_film = p.features = true;
    return p;
}
UpdatePlan film_size() {
    UpdatePlan p;
    p.camera = p.clear_film = true;
    return p;
}
UpdatePlan integrator() {
    UpdatePlan p;
    p.clear_film = p.features = true;
    return p;
}
UpdatePlan lights() {
    UpdatePlan p;
    p.lights = p.clear_film = p.features = true;
    return p;
}
UpdatePlan environment() {
    UpdatePlan p = lights();
    p.environment_parameters = true;
    return p;
}
UpdatePlan environment_image() {
    UpdatePlan p = environment();
    p.environment_map = true;
    return p;
}
UpdatePlan one_material(uint32_t id) {
    UpdatePlan p = lights();
    p.materials = {Id<Material>{id}};
    return p;
}
UpdatePlan every_material() {
    UpdatePlan p = lights();
    p.all_materials = true;
    return p;
}
UpdatePlan moved() {
    UpdatePlan p = lights();
    p.transforms = true;
    return p;
}
// The mesh of an area light.
UpdatePlan moved_panel(Id<Node> body) {
    UpdatePlan p = lights();
    p.moved_area_lights = {body};
    return p;
}
UpdatePlan object_list_rebuilt() {
    UpdatePlan p = moved();
    p.objects = p.all_materials = true;
    return p;
}

UpdatePlan plan_if(auto&& fill) {
    Changes c;
    fill(c);
    return plan(c);
}

TEST(UpdatePlan, EachChangeNeedsItsUpdatesOnly) {
    EXPECT_EQ(plan(Changes{}), nothing());
    EXPECT_EQ(plan_if([](Changes& c) { c.stop_rules = true; }), nothing());
    EXPECT_EQ(plan_if([](Changes& c) { c.view = true; }), camera());
    EXPECT_EQ(plan_if([](Changes& c) { c.resolution = true; }), film_size());
    EXPECT_EQ(plan_if([](Changes& c) { c.integrator = true; }), integrator());
    EXPECT_EQ(plan_if([](Changes& c) { c.integrator = c.nee_changed = true; }), environment_image()) << "all sampling tables";
    EXPECT_EQ(plan_if([](Changes& c) { c.environment_parameters = true; }), environment());
    EXPECT_EQ(plan_if([](Changes& c) { c.environment_image = true; }), environment_image());
    EXPECT_EQ(plan_if([](Changes& c) { c.transforms = {{1}}; }), lights()) << "no mesh is below it";
    EXPECT_EQ(plan_if([](Changes& c) { c.transforms = c.moved_meshes = {{1}}; }), moved());
    const Id<Node> body{expanded_id_bit | 1};
    EXPECT_EQ(plan_if([&](Changes& c) { c.transforms = {{1}}, c.moved_meshes = {body}; }), moved_panel(body));
    EXPECT_EQ(plan_if([&](Changes& c) { c.transforms = {{1}}, c.moved_meshes = {{2}, body}; }), moved()) << "not the panel alone";
    EXPECT_EQ(plan_if([](Changes& c) { c.structure = {{1}}; }), object_list_rebuilt());
    EXPECT_EQ(plan_if([](Changes& c) { c.meshes = {{1}}; }), object_list_rebuilt());
    EXPECT_EQ(plan_if([](Changes& c) { c.materials = {{7}}; }), one_material(7));
    EXPECT_EQ(plan_if([](Changes& c) { c.textures = {{1}}; }), every_material());
    EXPECT_EQ(plan_if([](Changes& c) { c.lights = {{1}}; }), lights());
    EXPECT_EQ(plan_if([](Changes& c) { c.mix = true; }), lights());
}

TEST(UpdatePlan, TwoChangesNeedTheUnion) {
    UpdatePlan both = moved();
    both.camera = true;
    EXPECT_EQ(plan_if([](Changes& c) { c.transforms = c.moved_meshes = {{1}}, c.view = true; }), both);
    EXPECT_EQ(plan_if([](Changes& c) { c.textures = {{1}}, c.materials = {{7}}; }), every_material()) << "all of them include the one";
}

TEST(UpdatePlan, TheFirstPlanIsFull) {
    const UpdatePlan p = full_plan();
    EXPECT_TRUE(p.objects && p.transforms && p.all_materials && p.lights && p.environment_map && p.environment_parameters && p.camera &&
                p.clear_film && p.features);
}

// The updates that an edit of the sample project causes.
UpdatePlan cost(const Project& before, const Edit& edit) {
    const Result<Project> after = blush::apply(before, edit);
    EXPECT_TRUE(after) << after.error().text();
    if (!after) return full_plan();
    return plan(diff(expand_area_lights(before.scene), before.render, expand_area_lights(after->scene), after->render));
}

class EditCost : public ::testing::Test {
protected:
    UpdatePlan cost_of(const Edit& edit) const { return cost(sample.project, edit); }
    UpdatePlan cost_of_node(Id<Node> id, auto&& with) const {
        Node node = *sample.project.scene.nodes.find(id);
        with(node);
        return cost_of(SetNode{id, node});
    }
    UpdatePlan cost_of_material(auto&& with) const {
        Material material = *sample.project.scene.materials.find(sample.red);
        with(material);
        return cost_of(SetMaterial{sample.red, material});
    }
    // Replaces the lamp for the rest of the test.
    void set_lamp(auto&& with) { sample.project = *blush::apply(sample.project, SetLight{sample.lamp, lamp(with)}); }
    UpdatePlan cost_of_lamp(auto&& with) const { return cost_of(SetLight{sample.lamp, lamp(with)}); }
    Light lamp(auto&& with) const {
        Light light = *sample.project.scene.lights.find(sample.lamp);
        with(light);
        return light;
    }
    UpdatePlan cost_of_render(auto&& with) const {
        RenderSettings settings = sample.project.render;
        with(settings);
        return cost_of(SetRender{settings});
    }
    UpdatePlan cost_of_environment(auto&& with) const {
        Environment e = sample.project.scene.environment;
        with(e);
        return cost_of(SetEnvironment{e});
    }

    Sample sample = sample_project();
};

TEST_F(EditCost, SetNode) {
    EXPECT_EQ(cost_of_node(sample.mug, [](Node& n) { n.local.translation.x += 1; }), moved());
    EXPECT_EQ(cost_of_node(sample.root, [](Node& n) { n.local.scale = {2, 2, 2}; }), moved());
    EXPECT_EQ(cost_of_node(sample.mug, [&](Node& n) { n.parent = sample.table; }), moved());
    EXPECT_EQ(cost_of_node(sample.mug, [](Node& n) { n.visible = false; }), object_list_rebuilt());
    EXPECT_EQ(cost_of_node(sample.mug, [](Node& n) { n.mesh = {}; }), object_list_rebuilt());
    EXPECT_EQ(cost_of_node(sample.mug, [](Node& n) { n.name = "Cup"; }), nothing());
    EXPECT_EQ(cost_of_node(sample.lamp_node, [](Node& n) { n.local.translation.x += 1; }), lights()) << "no object moves";
}

TEST_F(EditCost, SetMaterial) {
    EXPECT_EQ(cost_of_material([](Material& m) { m.roughness = 0.3f; }), one_material(sample.red.value));
    EXPECT_EQ(cost_of_material([](Material& m) { m.emissive = {1, 1, 1}; }), one_material(sample.red.value));
    EXPECT_EQ(cost_of_material([](Material& m) { m.name = "Crimson"; }), nothing());
}

TEST_F(EditCost, SetLight) {
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.intensity = 7; }), lights());
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.enabled = false; }), lights());
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.kind = Light::Kind::sun; }), lights());
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.name = "Bulb"; }), nothing());
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.kind = Light::Kind::rectangle; }), object_list_rebuilt()) << "a mesh appears";
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.kind = Light::Kind::disk, l.radius = 0.1f; }), object_list_rebuilt()) << "a mesh appears";
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.radius = 0.1f; }), lights()) << "a sphere is no mesh";
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.unit = Light::Unit::lumen, l.keep_power = true; }), nothing()) << "display only";
}

TEST_F(EditCost, SetAreaLight) {
    set_lamp([](Light& l) { l.kind = Light::Kind::rectangle; });
    const uint32_t body = expanded_id_bit | sample.lamp.value;
    const UpdatePlan panel_moves = moved_panel(Id<Node>{expanded_id_bit | sample.lamp_node.value});
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.intensity = 7; }), one_material(body));
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.color = {1, 0, 0}; }), one_material(body));
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.width = 3; }), panel_moves);
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.enabled = false; }), one_material(body)) << "its mesh stays";
    EXPECT_EQ(cost_of_lamp([](Light& l) { l.name = "Panel"; }), nothing());
    EXPECT_EQ(cost_of_node(sample.lamp_node, [](Node& n) { n.local.translation.x += 1; }), panel_moves);
    EXPECT_EQ(cost_of_node(sample.root, [](Node& n) { n.local.translation.x += 1; }), moved()) << "objects are below it too";
}

TEST_F(EditCost, SetCamera) {
    EXPECT_EQ(cost_of(SetCamera{sample.camera, {"Camera", {.yfov_radians = 1}}}), nothing()) << "the view is a copy";
}

TEST_F(EditCost, SetTexture) {
    Texture texture = *sample.project.scene.textures.find(sample.checker);
    texture.filter = Texture::Filter::nearest;
    EXPECT_EQ(cost_of(SetTexture{sample.checker, texture}), every_material());
    texture = *sample.project.scene.textures.find(sample.checker);
    texture.name = "Chess";
    EXPECT_EQ(cost_of(SetTexture{sample.checker, texture}), nothing());
}

TEST_F(EditCost, AssignMaterial) {
    EXPECT_EQ(cost_of(AssignMaterial{sample.quad, 0, sample.grey}), object_list_rebuilt());
    EXPECT_EQ(cost_of(AssignMaterial{sample.quad, 0, sample.red}), nothing());
}

TEST_F(EditCost, MakeEmissive) { EXPECT_EQ(cost_of(MakeEmissive{sample.mug, 5}), object_list_rebuilt()); }

TEST_F(EditCost, SetEnvironment) {
    EXPECT_EQ(cost_of_environment([](Environment& e) { e.intensity = 3; }), environment());
    EXPECT_EQ(cost_of_environment([](Environment& e) { e.visible_to_camera = false; }), environment());
    EXPECT_EQ(cost_of_environment([](Environment& e) { e.lights_scene = false; }), environment());
    EXPECT_EQ(cost_of_environment([](Environment& e) { e.kind = Environment::Kind::none; }), environment_image());
    EXPECT_EQ(cost_of_environment([](Environment& e) { e.sky.turbidity = 5; }), nothing()) << "the sky is unused";
    sample.project.scene.environment.kind = Environment::Kind::sky;
    EXPECT_EQ(cost_of_environment([](Environment& e) { e.sky.turbidity = 5; }), environment_image());
}

TEST_F(EditCost, SetLens) { EXPECT_EQ(cost_of(SetLens{{.aperture_radius = 0.1f}}), camera()); }

TEST_F(EditCost, SetSceneSelection) {
    EXPECT_EQ(cost_of(SetSceneSelection{{.seconds = 1}}), nothing()) << "no clip is selected";
    EXPECT_EQ(cost_of(SetSceneSelection{{.clip = sample.swing, .seconds = 1}}), moved());
    EXPECT_EQ(cost_of(SetSceneSelection{{.variant = 1}}), object_list_rebuilt()) << "another material";
}

TEST_F(EditCost, SetRender) {
    EXPECT_EQ(cost_of_render([](RenderSettings& r) { r.spp = 7, r.seconds = 8, r.error = 9; }), nothing());
    EXPECT_EQ(cost_of_render([](RenderSettings& r) { r.width = 7; }), film_size());
    EXPECT_EQ(cost_of_render([](RenderSettings& r) { r.seed = 7; }), integrator());
    EXPECT_EQ(cost_of_render([](RenderSettings& r) { r.max_bounces = 7; }), integrator());
    EXPECT_EQ(cost_of_render([](RenderSettings& r) { r.energy_compensation = true; }), integrator());
}

TEST_F(EditCost, SetView) { EXPECT_EQ(cost_of(SetView{{.exposure_ev = 2}}), nothing()) << "exposure is for the display"; }

TEST_F(EditCost, AddDuplicateRemoveImport) {
    EXPECT_EQ(cost_of(AddLight{}), object_list_rebuilt());
    EXPECT_EQ(cost_of(DuplicateNode{sample.mug}), object_list_rebuilt());
    EXPECT_EQ(cost_of(RemoveNode{sample.mug}), object_list_rebuilt());
    EXPECT_EQ(cost_of(Import{sample_project().project.scene, "sample"}), object_list_rebuilt());
}

TEST_F(EditCost, LookThrough) {
    EXPECT_EQ(cost_of(LookThrough{sample.camera_node}), camera());
    sample.project = *blush::apply(sample.project, LookThrough{sample.camera_node});
    EXPECT_EQ(cost_of(LookThrough{sample.camera_node}), nothing());
}

TEST_F(EditCost, OrbitingAboutAnotherPointIsNoChange) {
    Scene after = sample.project.scene;
    after.view.pivot_distance *= 2;
    EXPECT_EQ(plan(diff(sample.project.scene, sample.project.render, after, sample.project.render)), nothing());
}

} // namespace
} // namespace blush::TEST_FILE
