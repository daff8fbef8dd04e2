// The profile by stage: stages that a scene needs take time, the others take none, and the sum is time of the threads.
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <chrono>
#include <numeric>

namespace blush::test::TEST_FILE {
namespace {

struct Profile {
    StageSeconds stages;
    double thread_seconds; // that the threads had
};

Profile profile_of(const Scene& scene, const RenderSettings& settings, unsigned threads = 2) {
    Renderer renderer({.threads = threads});
    renderer.update(scene, settings);
    const auto begun = std::chrono::steady_clock::now();
    renderer.render(0, settings.spp);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun;
    return {renderer.resolve().stages, seconds.count() * threads};
}

TEST(StageTimes, ArePartsOfTheTimeOfTheThreads) {
    for (const unsigned threads : {1u, 2u}) {
        const Profile p = profile_of(shipped_scene("cornell"), settings_for(64, 48, 16), threads);
        const double sum = std::accumulate(p.stages.of.begin(), p.stages.of.end(), 0.0);
        EXPECT_LE(sum, 1.01 * p.thread_seconds) << "the rate of the time stamps is measured against a clock";
        for (const Stage stage : {Stage::generate, Stage::trace, Stage::light, Stage::shade, Stage::shadow, Stage::film})
            EXPECT_GT(p.stages[stage], 0) << stage_names[size_t(stage)];
    }
}

TEST(StageTimes, AreZeroForStagesThatAreLeftOut) {
    RenderSettings settings = settings_for(64, 48, 4);
    EXPECT_EQ(profile_of(shipped_scene("cornell"), settings).stages[Stage::reuse], 0);
    settings.reuse = 8;
    EXPECT_GT(profile_of(shipped_scene("cornell"), settings).stages[Stage::reuse], 0);
    Scene furnace;
    place(furnace, sphere(false), lambert(0.5f));
    constant_world(furnace, 1);
    furnace.view = looking({0, 0, 4}, {0, 0, 0}, 0.7f);
    settings.strategy = Strategy::bsdf;
    EXPECT_EQ(profile_of(furnace, settings).stages[Stage::light], 0) << "no light is sampled";
}

TEST(StageTimes, StartAnewWithTheFilm) {
    Renderer renderer({.threads = 1});
    renderer.update(shipped_scene("cornell"), settings_for(64, 48, 4));
    renderer.render(0, 4);
    EXPECT_GT(renderer.resolve().stages[Stage::trace], 0);
    renderer.clear();
    EXPECT_EQ(renderer.resolve().stages[Stage::trace], 0);
}

} // namespace
} // namespace blush::test::TEST_FILE
