// The Farm panel: which plans can be made, what each state of a plan offers, and no text that is cut off.
#include "tests/support/process.h"
#include "tests/support/sample_project.h"
#include "tests/ui/clipped_text.h"
#include "tests/ui/imgui_test.h"
#include "tests/ui/shipped_ocio_config.h"
#include "ui/panels/panels.h"
#include "ui/window/theme.h"

#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace blush::TEST_FILE {
namespace {

using State = FarmPlan::State;
using What = FarmChoices::What;

FarmPlan plan(State state, double fraction = 0) {
    const bool begun = fraction > 0;
    return {
        .folder = fmt::format("/home/somebody/plan_of_the_second_bedroom_beside_the_mirrored_wardrobe_{}_{}", int(state), begun),
        .state = state,
        .problem = state == State::unreadable ? "plan.json: the plan is of another version of this program, 0.0.0" : "",
        .tasks = 123456,
        .done = begun ? 60000 : 0,
        .running = 12,
        .fraction = fraction,
        .seconds_left = 123456,
        .looks =
            {{.name = "bedroom", .samples = 512, .planned = 4096, .merged = begun ? 512 : 0, .error = "0.0004614 (0.000432 to 0.0004928)"}},
        .failures = begun ? std::vector<std::string>(
                                3, "Task 17 of bedroom failed: /home/somebody/bedroom.gltf: has changed since the plan was made")
                          : std::vector<std::string>(),
        .seconds_here = 987654,
        .knee = 1024,
        .seconds_knee = 1234,
        .disk_mib = 123456};
}

class FarmPanel : public test::ImGuiTest {
protected:
    FarmPanel() {
        ui.probe = Probe(folder / "probe.json");
        ui.farm.parent = "/home/somebody/pictures_of_the_second_bedroom_beside_the_mirrored_wardrobe";
    }
    void draw(float ems = 28) {
        for (int i = 0; i < 2; ++i) {
            ui.probe.begin_frame();
            ImGui::NewFrame();
            const float width = ems * ImGui::GetFontSize();
            ImGui::GetIO().DisplaySize = {width + 50, 4000};
            ImGui::SetNextWindowPos({0, 0});
            ImGui::SetNextWindowSize({width, 4000});
            ImGui::Begin("dock", nullptr, ImGuiWindowFlags_NoDecoration);
            PanelContext c{document, ui, color, nullptr, SessionStatus(), 640, 360};
            draw_farm_panel(c);
            ImGui::End();
            ImGui::Render();
            ui.probe.end_frame({});
        }
    }
    // Their buttons, without the name of the plan.
    std::vector<std::string> buttons_of(const FarmPlan& plan) {
        ui.farm.plans = {plan};
        draw();
        std::vector<std::string> found;
        for (const char* button : {"Start", "Continue", "Stop", "Cancel", "Open", "Forget"})
            if (shows(fmt::format("Farm/{}/{}", plan.folder.filename().string(), button))) found.emplace_back(button);
        return found;
    }
    bool shows(const std::string& widget) const {
        std::ifstream in(folder / "probe.json");
        const std::string text(std::istreambuf_iterator<char>(in), {});
        return text.find("\"" + widget + "\"") != text.npos;
    }

    test::TemporaryFolder folder;
    const ColorManagement color = test::our_colors();
    Document document{test::sample_project().project};
    UiState ui;
};

TEST_F(FarmPanel, OffersWhatThePlanCanDo) {
    using Buttons = std::vector<std::string>;
    EXPECT_EQ(buttons_of(plan(State::stopped)), (Buttons{"Start", "Open", "Forget"}));
    EXPECT_EQ(buttons_of(plan(State::stopped, 0.5)), (Buttons{"Continue", "Open", "Forget"}));
    EXPECT_EQ(buttons_of(plan(State::running, 0.5)), (Buttons{"Stop", "Open"}));
    EXPECT_EQ(buttons_of(plan(State::making)), (Buttons{"Cancel"}));
    EXPECT_EQ(buttons_of(plan(State::finished, 1)), (Buttons{"Open", "Forget"}));
    EXPECT_EQ(buttons_of(plan(State::unreadable)), (Buttons{"Forget"}));
    EXPECT_TRUE(ui.farm.requests.empty());
    EXPECT_FALSE(document.can_undo()) << "drawing edits nothing";
}

TEST_F(FarmPanel, IsReadableInEveryState) {
    for (const State state : {State::unread, State::making, State::stopped, State::running, State::finished, State::unreadable})
        for (const double fraction : {0.0, 0.5}) ui.farm.plans.push_back(plan(state, fraction));
    ui.farm.choices.slurm_options = "--partition=the_partition_of_the_second_bedroom --cpus-per-task=16";
    for (const bool slurm : {false, true})
        for (int what = 0; what <= int(What::looks); ++what)
            for (const float ems : {18.f, 28.f, 60.f}) {
                ui.farm.has_slurm = slurm;
                ui.farm.choices.what = What(what);
                ui.farm.choices.by_error = slurm;
                ui.farm.choices.where = slurm ? FarmChoices::Where::slurm : FarmChoices::Where::here;
                ui.farm.choices.looks_file = "/home/somebody/looks_of_the_second_bedroom_beside_the_mirrored_wardrobe.json";
                draw(ems);
                EXPECT_EQ(test::unreadable_text(*ImGui::GetDrawData()), std::vector<std::string>()) << "what " << what << ", width " << ems;
            }
}

TEST_F(FarmPanel, SaysWhyNoPlanCanBeMade) {
    document.reset(Project());
    for (const What what : {What::snapshots, What::animation, What::cameras, What::variants, What::looks}) {
        ui.farm.choices.what = what;
        draw();
        EXPECT_TRUE(shows("Farm/No plan")) << int(what);
    }
    ui.farm.choices.what = What::view;
    draw();
    EXPECT_FALSE(shows("Farm/No plan"));
    ui.farm.plans = {plan(State::making)};
    draw();
    EXPECT_TRUE(shows("Farm/No plan")) << "one at a time";
}

TEST(FarmView, SnapshotsAreThoseOfTheSceneButNotOfItsPlans) {
    FarmView farm;
    farm.scene_file = "/mug.gltf";
    farm.plans = {{.folder = "/mug-plan-0001"}};
    SnapshotsView snapshots;
    const auto add = [&](const char* file, const char* scene, const char* no_state = "") {
        Snapshot s;
        s.file = file;
        s.scene_file = scene;
        s.no_state = no_state;
        snapshots.add(std::move(s));
    };
    add("/a.exr", "/mug.gltf");
    add("", "/mug.gltf");
    add("/b.exr", "/card.gltf");
    add("/c.exr", "/mug.gltf", "its edits do not fit");
    add("/mug-plan-0001/merged/mug.exr", "/mug.gltf");
    add("/d.exr", "/mug.gltf");
    EXPECT_EQ(saved_snapshots(snapshots, farm), (std::vector<std::string>{"/a.exr", "/d.exr"}));
}

TEST(FarmView, ShowsTheRunningPlanWithTheLeastLeft) {
    FarmView view;
    EXPECT_EQ(view.running(), nullptr);
    view.plans = {plan(State::stopped), plan(State::running, 0.2), plan(State::running, 0.996)};
    view.plans[2].seconds_left = 90;
    ASSERT_EQ(view.running(), &view.plans[2]);
    EXPECT_EQ(progress_text(view.plans[2]), "99 %, 90 s left") << "not full before the end";
}

} // namespace
} // namespace blush::TEST_FILE
