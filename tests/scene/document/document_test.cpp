#include "scene/changes.h"
#include "scene/document/document.h"
#include "tests/support/random_edits.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

namespace blush::TEST_FILE {
namespace {

using test::Sample;
using test::sample_project;

Light lamp_of(const Sample& s, float intensity) {
    Light lamp = *s.project.scene.lights.find(s.lamp);
    lamp.intensity = intensity;
    return lamp;
}

View moved_view(const Document& document, float x) {
    View view = document.project().scene.view;
    view.position.x = x;
    return view;
}

TEST(Document, UndoAndRedoGoThroughTheSameProjects) {
    const Sample s = sample_project();
    Document document(s.project);
    ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, 5)}));
    const Project five = document.project();
    ASSERT_TRUE(document.apply(SetView{{.exposure_ev = 1}}));
    EXPECT_EQ(document.undo_label(), "Change display settings");
    EXPECT_TRUE(document.undo());
    EXPECT_EQ(document.project(), five);
    EXPECT_TRUE(document.undo());
    EXPECT_EQ(document.project(), s.project);
    EXPECT_FALSE(document.undo());
    EXPECT_EQ(document.redo_label(), "Change light Lamp");
    EXPECT_TRUE(document.redo());
    EXPECT_EQ(document.project(), five);
    EXPECT_TRUE(document.can_redo());
    ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, 6)}));
    EXPECT_FALSE(document.can_redo()) << "a new edit replaces what was undone";
}

TEST(Document, UndoneTablesAreSharedWithTheOriginal) {
    const Sample s = sample_project();
    Document document(s.project);
    ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, 5)}));
    EXPECT_TRUE(document.project().scene.nodes.shares_storage(s.project.scene.nodes));
    EXPECT_FALSE(document.project().scene.lights.shares_storage(s.project.scene.lights));
    document.undo();
    EXPECT_TRUE(document.project().scene.lights.shares_storage(s.project.scene.lights));
}

TEST(Document, OneGestureIsOneStep) {
    const Sample s = sample_project();
    Document document(s.project);
    for (int i = 1; i <= 10; ++i) ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, float(i))}, 77));
    ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, 50)}, 78));
    EXPECT_TRUE(document.undo());
    EXPECT_EQ(document.project().scene.lights.find(s.lamp)->intensity, 10);
    EXPECT_TRUE(document.undo());
    EXPECT_EQ(document.project(), s.project);
    EXPECT_FALSE(document.can_undo());
    EXPECT_TRUE(document.redo());
    EXPECT_EQ(document.project().scene.lights.find(s.lamp)->intensity, 10) << "the whole drag at once";
}

TEST(Document, EditsWithoutAGestureAreStepsOfTheirOwn) {
    const Sample s = sample_project();
    Document document(s.project);
    for (int i = 1; i <= 3; ++i) ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, float(i))}));
    int steps = 0;
    while (document.undo()) ++steps;
    EXPECT_EQ(steps, 3);
}

TEST(Document, AGestureThatGoesOnAfterUndoIsANewStep) {
    const Sample s = sample_project();
    Document document(s.project);
    ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, 1)}, 5));
    ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, 2)}, 6));
    document.undo();
    ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, 3)}, 5));
    document.undo();
    EXPECT_EQ(document.project().scene.lights.find(s.lamp)->intensity, 1);
}

TEST(Document, AnEditWithoutAChangeMakesNoStep) {
    const Sample s = sample_project();
    Document document(s.project);
    const uint64_t revision = document.revision();
    ASSERT_TRUE(document.apply(SetLight{s.lamp, *s.project.scene.lights.find(s.lamp)}));
    EXPECT_FALSE(document.can_undo());
    EXPECT_EQ(document.revision(), revision);
}

TEST(Document, ARefusedEditChangesNothing) {
    const Sample s = sample_project();
    Document document(s.project);
    const uint64_t revision = document.revision();
    EXPECT_FALSE(document.apply(SetLight{{999}, Light{}}));
    EXPECT_EQ(document.project(), s.project);
    EXPECT_FALSE(document.can_undo());
    EXPECT_EQ(document.revision(), revision);
}

TEST(Document, RevisionGrowsWithEveryChange) {
    const Sample s = sample_project();
    Document document(s.project);
    uint64_t last = document.revision();
    const auto expect_grown = [&](const char* what) {
        EXPECT_GT(document.revision(), last) << what;
        last = document.revision();
    };
    ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, 1)}));
    expect_grown("edit");
    document.navigate(moved_view(document, 3));
    expect_grown("navigation");
    document.undo();
    expect_grown("undo");
    document.redo();
    expect_grown("redo");
    document.reset(s.project);
    expect_grown("reset");
}

TEST(Document, NavigationSurvivesUndoAndRedo) {
    const Sample s = sample_project();
    Document document(s.project);
    ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, 5)}));
    document.navigate(moved_view(document, 3));
    EXPECT_TRUE(document.undo());
    EXPECT_EQ(document.project().scene.view.position.x, 3);
    EXPECT_EQ(document.project().scene.lights.find(s.lamp)->intensity, 100);
    document.navigate(moved_view(document, 4));
    EXPECT_TRUE(document.redo());
    EXPECT_EQ(document.project().scene.view.position.x, 4);
    EXPECT_EQ(document.project().scene.lights.find(s.lamp)->intensity, 5);
}

TEST(Document, TheLensIsEditedNotNavigated) {
    const Sample s = sample_project();
    Document document(s.project);
    View view = moved_view(document, 3);
    view.lens.aperture_radius = 0.5f;
    document.navigate(view);
    EXPECT_EQ(document.project().scene.view.lens, s.project.scene.view.lens);
    ASSERT_TRUE(document.apply(SetLens{{.yfov_radians = 1}}));
    EXPECT_TRUE(document.undo());
    EXPECT_EQ(document.project().scene.view.lens, s.project.scene.view.lens);
    EXPECT_EQ(document.project().scene.view.position.x, 3);
}

TEST(Document, UndoingLookThroughRestoresTheView) {
    const Sample s = sample_project();
    Document document(s.project);
    document.navigate(moved_view(document, 3));
    ASSERT_TRUE(document.apply(LookThrough{s.camera_node}));
    EXPECT_EQ(document.project().scene.view.position, (Vec3{0, 0, 4}));
    EXPECT_TRUE(document.undo());
    EXPECT_EQ(document.project().scene.view.position.x, 3);
}

TEST(Document, ModifiedComparesValues) {
    const Sample s = sample_project();
    Document document(s.project);
    EXPECT_FALSE(document.modified());
    document.navigate(moved_view(document, 3));
    EXPECT_FALSE(document.modified()) << "navigation is not a modification";
    ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, 5)}));
    EXPECT_TRUE(document.modified());
    document.undo();
    EXPECT_FALSE(document.modified());
    document.redo();
    document.mark_saved();
    EXPECT_FALSE(document.modified());
    document.undo();
    EXPECT_TRUE(document.modified());
}

TEST(Document, HistoryDropsItsOldestSteps) {
    const Sample s = sample_project();
    Document document(s.project);
    for (int i = 1; i <= 600; ++i) ASSERT_TRUE(document.apply(SetLight{s.lamp, lamp_of(s, float(i))}));
    int steps = 0;
    while (document.undo()) ++steps;
    EXPECT_EQ(steps, 500);
    EXPECT_EQ(document.project().scene.lights.find(s.lamp)->intensity, 100);
}

TEST(Document, HistoryIsLimitedInMemory) {
    // 64 x 32 pixels of three floats are 24 KiB, and a step is a few KiB more: three of them fit, a fourth does not.
    constexpr size_t image_bytes = 64 * 32 * 3 * sizeof(float);
    Document document(sample_project().project, {.bytes = 4 * image_bytes});
    for (int i = 0; i < 8; ++i) {
        Environment environment;
        environment.kind = Environment::Kind::image;
        environment.image = test::uniform_image(64, 32, 3, float(i));
        ASSERT_TRUE(document.apply(SetEnvironment{environment}));
    }
    int steps = 0;
    while (document.undo()) ++steps;
    EXPECT_EQ(steps, 3);
}

TEST(Document, TheLastStepIsAlwaysKept) {
    Document document(sample_project().project, {.bytes = 1});
    ASSERT_TRUE(document.apply(SetView{{.exposure_ev = 1}}));
    ASSERT_TRUE(document.apply(SetView{{.exposure_ev = 2}}));
    EXPECT_TRUE(document.undo());
    EXPECT_EQ(document.project().view.exposure_ev, 1);
    EXPECT_FALSE(document.undo());
}

TEST(Document, RandomEditsAllUndone) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
        test::Rng rng(seed);
        Document document(sample_project().project);
        const Project first = document.project();
        std::vector<Project> passed{first};
        for (int i = 0; i < 250; ++i) {
            const Project before = document.project();
            ASSERT_TRUE(document.apply(test::random_edit(rng, before)));
            if (document.project() != before) passed.push_back(document.project());
        }
        const Project last = document.project();
        for (size_t i = passed.size(); i-- > 0;) {
            ASSERT_EQ(document.project(), passed[i]) << "seed " << seed << " step " << i;
            ASSERT_EQ(document.undo(), i > 0);
        }
        ASSERT_EQ(document.project(), first);
        EXPECT_FALSE(diff(first.scene, first.render, document.project().scene, document.project().render).any());
        while (document.redo()) {}
        ASSERT_EQ(document.project(), last);
    }
}

TEST(Document, EveryKindOfEditHasALabel) {
    test::Rng rng(1);
    Project project = sample_project().project;
    project.scene.mix.channels.push_back({.group = "Lamp"}); // something to bake
    for (size_t kind = 0; kind < std::variant_size_v<Edit>; ++kind) {
        std::optional<Edit> edit;
        for (int tries = 0; !edit && tries < 1000; ++tries) edit = test::random_edit(rng, project, kind);
        ASSERT_TRUE(edit) << "kind " << kind;
        EXPECT_FALSE(label(*edit, project).empty()) << "kind " << kind;
    }
}

} // namespace
} // namespace blush::TEST_FILE
