// A scene reached by edits renders bit-identically to the same scene just opened.
#include "core/math.h"
#include "scene/affine.h"
#include "scene/document/document.h"
#include "scene/document/scene_selection.h"
#include "scene/geometry/tangents.h"
#include "tests/render/session/rich_project.h"
#include "tests/support/images.h"
#include "tests/support/random_edits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

namespace blush::TEST_FILE {
namespace {

using test::all_planes;
using test::fresh_image;
using test::same_pixels;

constexpr int64_t samples = 2;

// A renderer that is only updated, and the scene that it should show.
class Updated {
public:
    explicit Updated(const Project& project) { follow(project); }

    void follow(const Project& project) {
        // If the renderer reports that the film is still valid, it must be.
        if (renderer_.update(project.scene, project.render)) {
            renderer_.render(project.render.first_sample, samples);
            base_ = project;
        } else {
            ++kept_;
        }
        image_ = renderer_.resolve();
    }
    const Frame& image() const { return image_; }
    // The project that the film was rendered from; it may differ in the light mix only.
    const Project& base() const { return base_; }
    // Number of updates that kept the film.
    int kept() const { return kept_; }
    const CompiledInfo& info() { return renderer_.info(); }

private:
    Renderer renderer_{all_planes()};
    Frame image_;
    Project base_;
    int kept_ = 0;
};

constexpr size_t edit_kinds = std::variant_size_v<Edit>;
using Tried = std::array<int, edit_kinds>;

// The next edit: cycles through the kinds, so that each is tried many times; skips kinds without a target.
Edit next_edit(test::Rng& rng, const Project& project, int step, Tried& tried) {
    if (const std::optional<Edit> edit = test::random_edit(rng, project, size_t(step) % edit_kinds)) {
        ++tried[size_t(step) % edit_kinds];
        return *edit;
    }
    return test::random_edit(rng, project);
}

TEST(RichProject, IsInView) {
    const Project project = test::rich_project();
    const Frame image = fresh_image(project.scene, project.render, samples);
    EXPECT_GE(std::set<uint32_t>(image.object_id.begin(), image.object_id.end()).size(), 8u) << "edits of invisible objects test nothing";
    EXPECT_GE(std::set<uint32_t>(image.material_id.begin(), image.material_id.end()).size(), 6u);
    EXPECT_EQ(image.health.dropped(), 0);
}

class RandomEdits : public ::testing::TestWithParam<unsigned> {};

TEST_P(RandomEdits, RenderLikeAFreshSceneAndUndoToTheFirstImage) {
    test::Rng rng(GetParam());
    Document document(test::rich_project());
    Updated updated(document.project());
    const Frame first = updated.image();
    ASSERT_TRUE(same_pixels(first, fresh_image(document.project().scene, document.project().render, samples)));

    Tried tried{};
    for (int step = 0; step < 270; ++step) {
        const Edit edit = next_edit(rng, document.project(), step, tried);
        const std::string what = label(edit, document.project());
        ASSERT_TRUE(document.apply(edit)) << what;
        const Project& project = document.project();
        // Sometimes several edits are applied at once, as in the session.
        if (rng() % 4 == 0) continue;
        updated.follow(project);
        Renderer fresh(all_planes());
        fresh.update(updated.base().scene, updated.base().render);
        fresh.render(project.render.first_sample, samples);
        EXPECT_FALSE(fresh.update(project.scene, project.render)) << what;
        ASSERT_TRUE(same_pixels(updated.image(), fresh.resolve())) << "step " << step << ": " << what;
        EXPECT_EQ(updated.info().kernel, fresh.info().kernel) << what;
        EXPECT_EQ(updated.info().triangles, fresh.info().triangles) << what;
        EXPECT_EQ(updated.info().emissive_triangles, fresh.info().emissive_triangles) << what;
    }
    EXPECT_GT(updated.kept(), 20) << "no edit was applied by the mix";
    for (size_t kind = 0; kind < edit_kinds; ++kind) EXPECT_GT(tried[kind], 0) << "kind " << kind << " of edit was never tried";

    while (document.undo()) updated.follow(document.project());
    EXPECT_TRUE(same_pixels(updated.image(), first));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomEdits, ::testing::Values(1u, 2u));

// Times of clips, forward and backward: of nodes, of a skin and of a morph target.
TEST(Renderer, FollowsAnimationsBitForBit) {
    Project project = test::rich_project();
    Updated updated(project);
    const Frame first = updated.image();
    for (const auto& [id, clip] : Table<Clip>(project.scene.clips))
        for (const float t : {0.f, 0.7f, 1.9f, 0.7f}) {
            project.scene = with_scene_selection(project.scene, {.clip = id, .seconds = t});
            updated.follow(project);
            EXPECT_TRUE(same_pixels(updated.image(), fresh_image(project.scene, project.render, samples))) << clip.name << " at " << t;
            EXPECT_EQ(same_pixels(updated.image(), first), t == 0 && clip.name == "Swing") << clip.name << " at " << t;
        }
    project.scene = with_scene_selection(project.scene, {.scene = 1});
    updated.follow(project);
    EXPECT_TRUE(same_pixels(updated.image(), fresh_image(project.scene, project.render, samples)));
    EXPECT_FALSE(same_pixels(updated.image(), first)) << "the other scene looks the same";
    project.scene = with_scene_selection(project.scene, {});
    updated.follow(project);
    EXPECT_TRUE(same_pixels(updated.image(), first));
}

// Replaces each geometry by a copy modified by `change`.
Scene with_geometries(const Scene& scene, auto&& change) {
    Scene changed = scene;
    for (auto [id, mesh] : Table<Mesh>(scene.meshes)) {
        for (MeshPart& part : mesh.parts) {
            auto copy = std::make_shared<Geometry>(*part.geometry);
            copy->serial = next_payload_serial();
            change(part, *copy);
            part.geometry = std::move(copy);
        }
        changed.meshes.set(id, std::move(mesh));
    }
    return changed;
}

// Anisotropic materials, or coats with a normal map, on meshes imported without tangents: they render as if the meshes always had
// tangents, and removing them restores the original.
TEST(Renderer, MakesTangentsWhenAMaterialNeedsThem) {
    Project project = test::rich_project();
    const Material bumpy = std::ranges::find_if(project.scene.materials, [](const auto& m) { return m.value.name == "Bumpy"; })->value;
    const Table<Material> materials = project.scene.materials;
    project.scene = with_geometries(project.scene, [](const MeshPart&, Geometry& g) { g.tangents.clear(); });
    const auto restyle = [&](auto&& change) {
        for (auto [id, material] : materials) {
            material.normal_texture = {};
            material.roughness = 0.3f;
            material.metallic = 1;
            change(material);
            project.scene.materials.set(id, material);
        }
    };
    restyle([](Material&) {});
    Updated updated(project);
    const Frame plain = updated.image();
    const auto expect_tangents = [&](const char* what) {
        updated.follow(project);
        EXPECT_TRUE(same_pixels(updated.image(), fresh_image(project.scene, project.render, samples))) << what;
        EXPECT_FALSE(same_pixels(updated.image(), plain)) << what;
        size_t made = 0;
        const Scene prepared = with_geometries(project.scene, [&](const MeshPart& part, Geometry& g) {
            const int set = tangent_uv_set(project.scene, part);
            if (set < 0 || g.normals.empty() || !g.has_uv_set(set)) return;
            add_tangents(g, set);
            ++made;
        });
        EXPECT_GT(made, 2u) << what;
        EXPECT_TRUE(same_pixels(updated.image(), fresh_image(prepared, project.render, samples))) << what;
    };
    restyle([](Material& m) { m.anisotropy = 0.8f; });
    expect_tangents("stretched");
    restyle([](Material& m) { m.anisotropy = 0.4f; });
    expect_tangents("less");
    restyle([&](Material& m) {
        m.anisotropy = 0.4f;
        m.clearcoat = 1;
        m.clearcoat_normal_texture = {bumpy.normal_texture.texture, 1};
    });
    expect_tangents("coated, by the other UV set");
    project.scene = with_geometries(project.scene, [&](const MeshPart&, Geometry& g) {
        if (!g.normals.empty() && g.has_uv_set(0)) add_tangents(g, 0);
    });
    updated.follow(project);
    EXPECT_TRUE(same_pixels(updated.image(), fresh_image(project.scene, project.render, samples))) << "tangents of the first UV set";
    project.scene =
        with_geometries(project.scene, [](const MeshPart& part, Geometry& g) { g = *without_generated_tangents(part.geometry); });
    restyle([](Material&) {});
    updated.follow(project);
    EXPECT_TRUE(same_pixels(updated.image(), plain));
}

// Far from the origin a scene has another render origin: moving there and back restores the image, including tables that the edit
// itself does not update.
TEST(Renderer, FollowsASceneThatMovesFarAway) {
    Project project = test::rich_project();
    Updated updated(project);
    const Frame first = updated.image();
    const Scene near = project.scene;
    const auto move = [&](const Vec3& by) {
        project.scene = near;
        for (const auto& [id, root] : near.nodes) {
            if (root.parent) continue;
            Node moved = root;
            moved.local.translation = root.local.translation + by;
            if (moved.local.matrix) moved.local.matrix->t = moved.local.matrix->t + by;
            project.scene.nodes.set(id, moved);
        }
    };
    for (const float away : {1e3f, 1e6f, 1e6f + 8, 0.f}) {
        move({away, 0, 0});
        project.scene.view.position.x += away;
        updated.follow(project);
        EXPECT_TRUE(same_pixels(updated.image(), fresh_image(project.scene, project.render, samples))) << away;
    }
    EXPECT_TRUE(same_pixels(updated.image(), first));

    // Without the camera, which then has another origin: moved straight away from it, so that the scene stays in view.
    const Vec3d forward = to_affine(near.view.rotation).z * -1;
    move(to_float(forward * (6 * world_bounds(near).radius())));
    updated.follow(project);
    const Frame& small = updated.image();
    EXPECT_TRUE(same_pixels(small, fresh_image(project.scene, project.render, samples)));
    EXPECT_GT(std::count_if(small.object_id.begin(), small.object_id.end(), [](uint32_t id) { return id != 0; }), 10) << "too far to see";
}

TEST(Renderer, ThreadsAndBatchesDoNotChangeABit) {
    const Project project = test::rich_project();
    const Frame one = fresh_image(project.scene, project.render, 5, 1);
    EXPECT_TRUE(same_pixels(one, fresh_image(project.scene, project.render, 5, 2)));
    EXPECT_TRUE(same_pixels(one, fresh_image(project.scene, project.render, 5, 7)));
    Renderer split(all_planes());
    split.update(project.scene, project.render);
    for (const auto& [first, count] : {std::pair{0, 1}, {1, 1}, {2, 3}}) split.render(first, count);
    EXPECT_TRUE(same_pixels(one, split.resolve()));
}

// The pilot's decisions must not be reused for another scene.
TEST(Renderer, AdaptiveSamplingStartsAgainWithEachImage) {
    Project project = test::rich_project();
    project.render.adaptive = true;
    Renderer renderer(all_planes());
    const auto follow = [&](int64_t count) {
        renderer.update(project.scene, project.render);
        renderer.render(0, count);
        EXPECT_TRUE(same_pixels(renderer.resolve(), fresh_image(project.scene, project.render, count)));
    };
    follow(40);
    project.scene.environment.intensity *= 7;
    follow(40);
    project.render.width = 40;
    follow(40);
    project.scene.environment.intensity *= 2;
    follow(11);
    project.render.adaptive = false;
    follow(18);
}

TEST(Renderer, DividersLeaveNoTrace) {
    const Project project = test::rich_project();
    Renderer renderer(all_planes());
    renderer.update(project.scene, project.render);
    renderer.set_divider(4);
    renderer.render(0, 1);
    EXPECT_EQ(renderer.resolve().width, 12);
    renderer.set_divider(1);
    renderer.render(0, 3);
    EXPECT_TRUE(same_pixels(renderer.resolve(), fresh_image(project.scene, project.render, 3)));
}

TEST(Renderer, AStoppedPassStopsAndLeavesNoTraceAfterClearing) {
    const Project project = test::rich_project();
    Renderer renderer(all_planes(1));
    renderer.update(project.scene, project.render);
    EXPECT_FALSE(renderer.render(0, 2, [] { return false; }));
    EXPECT_EQ(renderer.resolve().samples, 0);
    int asked = 0;
    EXPECT_FALSE(renderer.render(0, 2, [&] { return ++asked < 2; })) << "stopped after the first tile";
    renderer.clear();
    EXPECT_TRUE(renderer.render(0, 2));
    EXPECT_TRUE(same_pixels(renderer.resolve(), fresh_image(project.scene, project.render, 2)));
}

} // namespace
} // namespace blush::TEST_FILE
