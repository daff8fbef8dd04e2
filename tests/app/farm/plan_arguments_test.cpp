// The command line that the Farm panel runs.
#include "app/farm/plan_arguments.h"
#include "tests/app/commands/plan/plan_support.h"

#include <algorithm>

namespace blush::test::TEST_FILE {
namespace {

using What = FarmChoices::What;

// True if these words stand in the arguments, one after the other.
bool has(const Arguments& arguments, const Arguments& words) { return !std::ranges::search(arguments, words).empty(); }

const FarmSource source{.folder = "/plans/mug 1", .snapshots = {"/plans/mug 1/view.exr"}};

TEST(PlanArguments, SayWhatIsRendered) {
    EXPECT_TRUE(has(plan_arguments({}, source), {"plan", "-o", "/plans/mug 1", "--snapshots", "/plans/mug 1/view.exr", "--size"}));
    EXPECT_TRUE(has(plan_arguments({.what = What::turntable, .steps = 24}, source), {"--turntable", "24"}));
    EXPECT_TRUE(has(plan_arguments({.what = What::cameras}, source), {"--cameras", "all"}));
    EXPECT_TRUE(has(plan_arguments({.what = What::variants}, source), {"--variants", "all"}));
    EXPECT_TRUE(has(plan_arguments({.what = What::looks, .looks_file = "/a b/looks.json"}, source), {"--looks", "/a b/looks.json"}));
    FarmSource animated = source;
    animated.animation = 1;
    EXPECT_TRUE(has(plan_arguments({.what = What::animation, .first_frame = 3, .last_frame = 9, .frames_per_second = 30}, animated),
                    {"--animation", "1", "--frames", "3:9", "--fps", "30"}));
}

TEST(PlanArguments, SayHowWell) {
    const Arguments by_samples = plan_arguments({.width = 640, .spp = 256, .adaptive = false}, source);
    EXPECT_TRUE(has(by_samples, {"--size", "640x", "--spp", "256", "--adaptive", "off"}));
    const Arguments by_error = plan_arguments({.by_error = true, .spp = 256, .error_per_cent = 0.05f}, source);
    EXPECT_TRUE(has(by_error, {"--spp", "256", "--error", "0.0005", "--adaptive", "on"}));
    EXPECT_FALSE(has(by_samples, {"--error"}));
}

TEST(PlanArguments, ShowTheContactSheetAsTheWindow) {
    FarmSource shown = source;
    shown.view = {.exposure_ev = -1.5f, .view = "Raw", .white = {1, 0.5f, 0.25f}};
    shown.threads = 3;
    const Arguments arguments = plan_arguments({}, shown);
    EXPECT_TRUE(has(arguments, {"--exposure=-1.5"}));
    EXPECT_TRUE(has(arguments, {"--white", "1,0.5,0.25"}));
    EXPECT_TRUE(has(arguments, {"--view", "Raw"}));
    EXPECT_TRUE(has(arguments, {"--threads", "3"}));
    EXPECT_FALSE(has(arguments, {"--look"}));
}

// The command accepts them, and they mean the same to it.
TEST(PlanArguments, MakeAPlan) {
    const TemporaryFolder folder;
    const std::string scene = scene_copy(folder, "cornell");
    expect_done({"render", scene, "-o", folder / "view.exr", "--size", "80x48", "--spp", "1", "--quiet"});
    const FarmSource here{.folder = folder / "plan", .snapshots = {folder / "view.exr"}, .view = {.exposure_ev = -1}};
    expect_done(plan_arguments({.what = What::turntable, .steps = 2, .width = 40, .by_error = true, .spp = 64}, here));
    const nlohmann::json plan = json_of(folder / "plan/plan.json");
    EXPECT_EQ(plan["looks"].size(), 2u);
    EXPECT_EQ(plan["spp"], 64);
    EXPECT_EQ(plan["looks"][0]["set"]["size"], "40x");
    EXPECT_NEAR(plan["error"].get<double>(), 0.0001, 1e-9);
}

} // namespace
} // namespace blush::test::TEST_FILE
