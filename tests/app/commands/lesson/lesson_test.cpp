// Lessons: the format, hostile files, scenes, claims; each claim of the shipped lessons.
#include "app/commands/lesson/claims.h"
#include "app/commands/lesson/states.h"
#include "app/commands/progress.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

namespace blush::TEST_FILE {
namespace {

using test::blush;
using test::Finished;
using test::TemporaryFolder;

const std::string good = "---\nlesson: Title\n---\nAbout.\n"
                         "---\nstep: One\nscene: cornell.gltf\nset: size=32x32\nset: max-bounces=2\nopen: bleed, paths\ntool: bleed\n"
                         "question: Why?\nexpect: So.\n"
                         "claim: \"some light\": share of direct at 1,2,3,4 is 0.1 to 0.9\n---\nThere is some\nlight.\n"
                         "---\nstep: Two\nset: spp=4\n---\nText.\n"
                         "---\nstep: Three\nscene: card-and-mug.gltf\nreset: settings\n---\nMore.\n";

std::string written(const TemporaryFolder& folder, const std::string& text) {
    const std::string file = folder / "lesson.md";
    std::ofstream(file) << text;
    return file;
}

Result<Lesson> read(const std::string& file) { return read_lesson(file, BLUSH_ASSETS "/scenes"); }

std::string replaced(std::string text, const std::string& part, const std::string& by) {
    const size_t at = text.find(part);
    EXPECT_NE(at, text.npos) << part;
    return text.replace(at, part.size(), by);
}

TEST(Lesson, IsRead) {
    const Result<Lesson> lesson = parse_lesson(good, "a.md");
    ASSERT_TRUE(lesson) << lesson.error().text();
    EXPECT_EQ(lesson->title, "Title");
    EXPECT_EQ(lesson->about, "About.\n");
    ASSERT_EQ(lesson->steps.size(), 3u);
    const LessonStep &one = lesson->steps[0], &two = lesson->steps[1], &three = lesson->steps[2];
    EXPECT_EQ(one.title, "One");
    EXPECT_EQ(one.text, "There is some\nlight.\n");
    EXPECT_EQ(one.panels, (std::vector<std::string>{"bleed", "paths"}));
    EXPECT_EQ(one.tool, "bleed");
    EXPECT_EQ(one.question, "Why?");
    EXPECT_EQ(one.expect, "So.");
    ASSERT_EQ(one.claims.size(), 1u);
    EXPECT_EQ(one.claims[0].name, "direct");
    EXPECT_EQ(one.claims[0].rect, (std::array<int, 4>{1, 2, 3, 4}));
    EXPECT_EQ(one.claims[0].low, 0.1);
    EXPECT_EQ(one.claims[0].high, 0.9);
    // What the next step has of it: the scene and the settings, no panels, tools, claims.
    EXPECT_EQ(two.scene, "cornell.gltf");
    EXPECT_EQ(two.settings, (std::map<std::string, std::string>{{"size", "32x32"}, {"max-bounces", "2"}, {"spp", "4"}}));
    EXPECT_TRUE(two.panels.empty());
    EXPECT_EQ(two.tool, "");
    EXPECT_TRUE(two.claims.empty());
    EXPECT_TRUE(three.settings.empty());
    const Result<RenderOptions> options = options_of_step(two);
    ASSERT_TRUE(options);
    EXPECT_EQ(options->settings.spp, 4);
    EXPECT_EQ(options->settings.max_bounces, 2);
}

TEST(Lesson, ErrorsNameTheLine) {
    const struct {
        std::string part, by;
        int line;
        std::string what;
    } wrong[] = {
        {"---\nlesson", "lesson", 1, "begins with a line ---"},
        {"lesson: Title", "title: T", 2, "unknown key \"title\""},
        {"lesson: Title\n", "", 1, "no title"},
        {"step: One\n", "", 5, "no title"},
        {"question:", "quetsion:", 12, "unknown key \"quetsion\""},
        {"question: Why?", "question:", 12, "has no value"},
        {"question: Why?", "question", 12, "KEY: VALUE"},
        {"scene: cornell.gltf\n", "", 5, "needs a scene"},
        {"bleed, paths", "bleed, path", 10, "unknown panel \"path\""},
        {"tool: bleed", "tool: hammer", 11, "unknown tool \"hammer\""},
        {"max-bounces=2", "max-bounce=2", 9, "no setting \"max-bounce\""},
        {"max-bounces=2", "max-bounces=many", 9, "many"},
        {"max-bounces=2", "max-bounces", 9, "SETTING=VALUE"},
        {"max-bounces=2", "region=0,0,1,1", 9, "cannot set region"},
        {"max-bounces=2", "env=/etc/passwd", 9, "env must be none or constant"},
        {"spp=4", "spp=0", 20, "spp must be"},
        {"some\nlight", "no\nlight", 14, "does not say \"some light\""},
        {"0.1 to 0.9", "0.9 to 0.1", 14, "a claim must be"},
        {"0.1 to 0.9", "nan to 0.9", 14, "a claim must be"},
        {"at 1,2,3,4", "at 1,2,3,-4", 14, "a claim must be"},
        {"share of direct at 1,2,3,4", "noise with max-bounces=x", 14, "x"},
        {"reset: settings", "reset: all", 26, "reset can only be"},
        {"reset: settings\n---\nMore.\n", "reset: settings\n", 23, "second line ---"},
    };
    for (const auto& w : wrong) {
        const Result<Lesson> lesson = parse_lesson(replaced(good, w.part, w.by), "a.md");
        ASSERT_FALSE(lesson) << w.by;
        EXPECT_EQ(lesson.error().file, "a.md:" + std::to_string(w.line)) << lesson.error().text();
        EXPECT_NE(lesson.error().what.find(w.what), std::string::npos) << lesson.error().text();
    }
    EXPECT_FALSE(parse_lesson("", "a.md"));
    EXPECT_FALSE(parse_lesson("---\nlesson: Title\n---\n", "a.md"));
}

TEST(Lesson, HostileTextNeverCrashes) {
    std::mt19937 random(1);
    size_t valid = 0;
    for (int k = 0; k < 3000; ++k) {
        std::string text = good;
        for (int changes = 1 + int(random() % 4); changes > 0; --changes) {
            const size_t at = random() % text.size();
            if (const auto kind = random() % 3; kind == 0)
                text[at] = char(random());
            else if (kind == 1)
                text.erase(at, 1 + random() % 20);
            else
                text.insert(at, text.substr(random() % text.size(), random() % 40));
            if (text.empty()) text = "-";
        }
        valid += bool(parse_lesson(text, "a.md"));
    }
    EXPECT_GT(valid, 0u);
    EXPECT_LT(valid, 3000u);
    std::string steps = "---\nlesson: T\n---\n";
    for (size_t i = 0; i <= max_lesson_steps; ++i) steps += "---\nstep: S\nscene: cornell.gltf\n---\n";
    EXPECT_FALSE(parse_lesson(steps, "a.md"));
    EXPECT_FALSE(parse_lesson(std::string(max_lesson_bytes, '-'), "a.md"));
}

TEST(Lesson, ReadsNothingOutsideOfItsFolder) {
    const TemporaryFolder folder, other;
    const std::string scenes = BLUSH_ASSETS "/scenes";
    for (const char* file : {"cornell.gltf", "cornell.bin"}) std::filesystem::copy_file(scenes + "/" + file, other / file);
    const auto with_scene = [&](const std::string& scene) { return read(written(folder, replaced(good, "cornell.gltf", scene))); };
    ASSERT_TRUE(with_scene("cornell.gltf")); // shipped
    EXPECT_FALSE(with_scene("missing.gltf"));
    EXPECT_FALSE(with_scene(other / "cornell.gltf"));
    EXPECT_FALSE(with_scene("../" + std::filesystem::path(other / "").parent_path().filename().string() + "/cornell.gltf"));
    EXPECT_FALSE(with_scene("../scenes/cornell.gltf"));
    EXPECT_FALSE(with_scene(".")); // a folder
    std::filesystem::create_symlink(other / "cornell.gltf", folder / "linked.gltf");
    const Result<Lesson> linked = with_scene("linked.gltf");
    ASSERT_FALSE(linked);
    EXPECT_TRUE(linked.error().file.ends_with("lesson.md:7")) << linked.error().text();
    std::filesystem::copy_file(other / "cornell.gltf", folder / "own.gltf");
    EXPECT_TRUE(with_scene("own.gltf"));
    std::ofstream(folder / "lesson.md") << std::string(max_lesson_bytes + 1, ' ');
    EXPECT_FALSE(read(folder / "lesson.md"));
}

TEST(Lesson, StatesAreThoseOfTheSteps) {
    const TemporaryFolder folder;
    const Result<Lesson> lesson = read(written(folder, replaced(good, "card-and-mug.gltf", "card-and-mug.gltf\ncamera: from above")));
    ASSERT_TRUE(lesson) << lesson.error().text();
    Progress progress(true);
    const auto states = states_of(*lesson, progress, false);
    ASSERT_TRUE(states) << states.error().text();
    ASSERT_EQ(states->size(), 3u);
    EXPECT_EQ((*states)[0].render.max_bounces, 2);
    EXPECT_EQ((*states)[1].render.spp, 4);
    EXPECT_EQ((*states)[2].render.max_bounces, unlimited_bounces);
    EXPECT_EQ(camera_name((*states)[2].scene), "from above");
}

TEST(Lesson, HighlightsAWidgetByItsName) {
    const auto with = [](const std::string& widget) { return parse_lesson(replaced(good, "tool: bleed", "highlight: " + widget), "a.md"); };
    for (const char* valid : {"Lesson/Next", "Menu bar/Help", "Roulette/Rule/max"}) {
        const Result<Lesson> lesson = with(valid);
        ASSERT_TRUE(lesson) << lesson.error().text();
        EXPECT_EQ(lesson->steps[0].highlight, valid);
        EXPECT_EQ(lesson->steps[1].highlight, "") << "a highlight does not carry over";
    }
    for (const std::string& wrong :
         {std::string("Next"), std::string("/Next"), std::string("Lesson/"), std::string("Lesson//Next"), std::string("Lesson /Next"),
          std::string("Lesson/\x01"), "Lesson/" + std::string(max_highlight, 'x')}) {
        const Result<Lesson> lesson = with(wrong);
        ASSERT_FALSE(lesson) << wrong;
        EXPECT_EQ(lesson.error().file, "a.md:11");
        EXPECT_NE(lesson.error().what.find("PANEL/WIDGET"), std::string::npos) << lesson.error().text();
    }
}

TEST(LessonCommand, ChecksAFile) {
    const TemporaryFolder folder;
    const Finished valid = blush({"lesson", "check", written(folder, good)});
    EXPECT_EQ(valid.exit_code, 0) << valid.err;
    EXPECT_NE(valid.out.find("\"Title\", 3 steps, 1 claims"), std::string::npos) << valid.out;
    const Finished camera = blush({"lesson", "check", written(folder, replaced(good, "cornell.gltf", "cornell.gltf\ncamera: none"))});
    EXPECT_EQ(camera.exit_code, 1);
    EXPECT_NE(camera.err.find("lesson.md:8: there is no camera \"none\""), std::string::npos) << camera.err;
    const Finished rect = blush({"lesson", "check", written(folder, replaced(good, "1,2,3,4", "30,2,3,4"))});
    EXPECT_EQ(rect.exit_code, 1);
    EXPECT_NE(rect.err.find("lesson.md:14: the rectangle 30,2,3,4 is not within 32x32"), std::string::npos) << rect.err;
}

// Claims that are wrong must be found: of a share, of a sender that does not exist, of a mean.
TEST(LessonCommand, FindsWrongClaims) {
    const TemporaryFolder folder;
    const std::string true_claim = "share of direct at 14,14,4,4 is 0.4 to 0.9";
    const auto check = [&](const std::string& claim) {
        const std::string text = replaced(good, "share of direct at 1,2,3,4 is 0.1 to 0.9", claim);
        return blush({"lesson", "check", "--claims", written(folder, replaced(text, "max-bounces=2", "spp=4"))});
    };
    const Finished holds = check(true_claim);
    EXPECT_EQ(holds.exit_code, 0) << holds.err;
    EXPECT_NE(holds.out.find("all hold"), std::string::npos);
    for (const char* wrong : {"share of direct at 14,14,4,4 is 0.95 to 1", "share of a teapot at 14,14,4,4 is 0 to 1",
                              "mean with max-bounces=1 is 0.99 to 1.01", "noise with spp=16 is 0.9 to 1.1"}) {
        const Finished found = check(wrong);
        EXPECT_EQ(found.exit_code, 1) << wrong;
        EXPECT_NE(found.err.find("lesson.md:14: \"some light\" is"), std::string::npos) << found.err;
    }
}

std::vector<std::string> shipped_lessons() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(BLUSH_ASSETS "/lessons"))
        if (entry.is_directory()) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

class ShippedLessons : public testing::TestWithParam<std::string> {};

TEST_P(ShippedLessons, MakeTrueClaims) {
    const Finished checked = blush({"lesson", "check", "--claims", "--quiet", BLUSH_ASSETS "/lessons/" + GetParam() + "/lesson.md"});
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
}

INSTANTIATE_TEST_SUITE_P(All, ShippedLessons, testing::ValuesIn(shipped_lessons()), [](const auto& lesson) {
    std::string name = lesson.param;
    std::ranges::replace(name, '-', '_'); // of a test, an identifier
    return name;
});

} // namespace
} // namespace blush::TEST_FILE
