// The arithmetic of paths as text, and the lesson's example with it.
#include "render/diagnostics/path_arithmetic.h"

#include "render/diagnostics/path_recorder.h"
#include "tests/render/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace blush::test::TEST_FILE {
namespace {

std::vector<RecordedPath> paths_of_two_bounces(Strategy strategy, int64_t samples) {
    RenderSettings settings;
    settings.width = 64;
    settings.height = 36;
    settings.strategy = strategy;
    PathRecorder recorder;
    recorder.update(shipped_scene("two-bounces"), settings);
    return *recorder.record(32, 14, 0, samples, false);
}

bool is_the_lessons(const RecordedPath& path) {
    const auto& v = path.vertices;
    return v.size() == 3 && v[0].object == "red wall" && v[1].object == "white floor" && v[2].object == "lamp";
}

// A wall of 0.7, a floor of 0.9, a lamp of 12: with the cosine-weighted sampling of the BSDF alone every such path is worth 7.56.
TEST(PathArithmetic, ReproducesTheLessonsExample) {
    int found = 0;
    for (const RecordedPath& path : paths_of_two_bounces(Strategy::bsdf, 512)) {
        if (!is_the_lessons(path)) continue;
        ++found;
        EXPECT_FLOAT_EQ(path.vertices[0].factor.x, 0.7f);
        EXPECT_FLOAT_EQ(path.vertices[0].beta.x, 0.7f);
        EXPECT_FLOAT_EQ(path.vertices[1].beta.x, 0.63f);
        EXPECT_FLOAT_EQ(path.vertices[2].radiance.x, 12);
        EXPECT_FLOAT_EQ(path.radiance.x, 0.7f * 0.9f * 12);
        const std::vector<PathTerm> terms = terms_of(path, main_channel(path));
        ASSERT_EQ(terms.size(), 1u);
        EXPECT_EQ(terms[0].text, "0.7 x 0.9 x 12 = 7.56");
        EXPECT_FLOAT_EQ(terms[0].value, 7.56f);
        EXPECT_NE(path_text(path, RgbChannel::red).find("vertex 2 camera_hit   0.7 x 0.9 x 12 = 7.56\n"), std::string::npos)
            << path_text(path, RgbChannel::red);
    }
    EXPECT_GT(found, 10);
}

// With next event estimation the same product has its MIS weight behind it, and the terms sum to the path.
TEST(PathArithmetic, ShowsTheMisWeights) {
    int weighted = 0, sampled = 0;
    for (const RecordedPath& path : paths_of_two_bounces(Strategy::mis, 512)) {
        const std::vector<PathTerm> terms = terms_of(path, RgbChannel::red);
        float sum = 0;
        for (const PathTerm& term : terms) {
            sum += term.value;
            sampled += term.by == FoundBy::nee && term.text.find(" x 12 = ") != std::string::npos;
        }
        EXPECT_NEAR(sum, path.radiance.x, 1e-5f * (1 + path.radiance.x));
        if (!is_the_lessons(path)) continue;
        weighted +=
            terms.back().text.starts_with("0.7 x 0.9 x 12 = 7.56; x 0.") && terms.back().text.find("(MIS weight)") != std::string::npos;
    }
    EXPECT_GT(weighted, 10);
    EXPECT_GT(sampled, 100);
}

RecordedPath written_path() {
    RecordedPath path;
    PathVertex mirror, floor;
    mirror.scatters = ScatterKind::delta_reflection;
    mirror.factor = {0.5f, 0.25f, 1};
    mirror.beta = {1, 0.5f, 2};
    mirror.roulette = true;
    mirror.survival = 0.5f;
    floor.bounce = 1;
    floor.arriving = {1, 0.5f, 2};
    floor.end = PathEnd::roulette;
    floor.survival = 0.125f;
    floor.roulette = true;
    NextEvent e;
    e.f_cos = {0.25f, 0.25f, 0.25f};
    e.light_pdf = 0.5f;
    e.radiance = {8, 8, 8};
    e.sent = {4, 2, 8};
    e.arrived = {0, 0, 0};
    e.blocked = true;
    floor.next_event = e;
    path.vertices = {mirror, floor};
    return path;
}

TEST(PathArithmetic, DividesByTheSurvivalProbability) {
    RecordedPath path = written_path();
    path.vertices[1].next_event->blocked = false;
    path.vertices[1].next_event->arrived = {4, 2, 8};
    EXPECT_EQ(terms_of(path, RgbChannel::red)[0].text, "0.5 / 0.5 x 0.5 x 8 = 4");
    EXPECT_EQ(terms_of(path, RgbChannel::green)[0].text, "0.25 / 0.5 x 0.5 x 8 = 2");
    path.vertices[1].next_event->arrived = {1, 0.5f, 2};
    EXPECT_EQ(terms_of(path, RgbChannel::red)[0].text, "0.5 / 0.5 x 0.5 x 8 = 4; x 0.25 (panes and blended surfaces) = 1");
    EXPECT_FLOAT_EQ(terms_of(path, RgbChannel::red)[0].value, 1);
}

TEST(PathArithmetic, NamesBlockedLightAndTheEnd) {
    const RecordedPath path = written_path();
    const std::vector<PathTerm> terms = terms_of(path, RgbChannel::blue);
    ASSERT_EQ(terms.size(), 1u);
    EXPECT_EQ(terms[0].text, "1 / 0.5 x 0.5 x 8 = 8; blocked = 0");
    EXPECT_EQ(terms[0].value, 0);
    EXPECT_EQ(step_text(path.vertices[0], RgbChannel::red), "mirrors x 0.5 / 0.5 (roulette)");
    EXPECT_EQ(step_text(path.vertices[1], RgbChannel::red), "dies by roulette, q = 0.125");
    EXPECT_EQ(main_channel(path), RgbChannel::blue);
}

} // namespace
} // namespace blush::test::TEST_FILE
