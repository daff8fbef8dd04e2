// `blush converge`: options, output files, and detection of bias.
#include "app/commands/converge/reference_cache.h"
#include "app/commands/converge/variants.h"
#include "core/files.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace blush::test::TEST_FILE {
namespace {

// A temporary folder with its own cache.
class Converge : public testing::Test {
protected:
    TemporaryFolder temporary;
    const std::filesystem::path& folder = temporary.path();

    void SetUp() override { ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1); }
    void TearDown() override { ::unsetenv("XDG_CACHE_HOME"); }
    Finished run_converge(std::vector<std::string> options, const std::string& scene = "cornell") {
        std::vector<std::string> arguments{"converge", scene_file(scene), "-o", (folder / "out").string(), "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return blush(arguments);
    }
    std::string text(const std::string& name) {
        const auto bytes = read_file(folder / "out" / name, 1 << 28);
        return bytes ? std::string(bytes->begin(), bytes->end()) : std::string();
    }
    nlohmann::json json() { return nlohmann::json::parse(text("convergence.json"), nullptr, false); }
};

TEST(Variants, AreANameAndTheOptionsOfRender) {
    RenderOptions base;
    const auto v = parse_variant("  short paths : --max-bounces 2 --roulette off", base);
    ASSERT_TRUE(v) << v.error().text();
    EXPECT_EQ(v->name, "short paths");
    EXPECT_EQ(v->settings.max_bounces, 2);
    EXPECT_EQ(v->settings.roulette.rule, Roulette::Rule::off);
    EXPECT_EQ(v->settings.width, base.settings.width);
    for (const char* wrong : {"no colon", ": --strategy mis", "a: --strategy best", "a: --size 8x8", "a: --spp 3", "a: --seed 4",
                              "a: --env none", "a: --nonsense"})
        EXPECT_FALSE(parse_variant(wrong, base)) << wrong;
}

TEST(Variants, PresetsAllParse) {
    for (const char* preset : {"roulette", "strategies", "bounces", "samplers", "caustics", "tricks"}) {
        const auto variants = preset_variants(preset, {});
        ASSERT_TRUE(variants) << variants.error().text();
        EXPECT_GE(variants->size(), 2u);
    }
    EXPECT_FALSE(preset_variants("all", {}));
}

TEST_F(Converge, FindsTheBiasOfIntegrators) {
    const Finished f = run_converge({"--size", "48x48", "--spp", "64", "--repeats", "1", "--adaptive", "off", "--reuse", "off", "--variant",
                                     "paths: --integrator path", "--variant", "ambient: --integrator ambient", "--variant",
                                     "probes: --integrator light-probes"});
    ASSERT_EQ(f.exit_code, 0) << f.err;
    const auto j = json();
    ASSERT_EQ(j["variants"].size(), 3u);
    EXPECT_EQ(j["variants"][0]["bias"]["verdict"], "unbiased-within-noise");
    EXPECT_EQ(j["variants"][1]["bias"]["verdict"], "biased");
    EXPECT_EQ(j["variants"][2]["bias"]["verdict"], "biased");
    EXPECT_TRUE(j["variants"][1]["bias"]["bounces"].empty());
}

TEST_F(Converge, WritesCsvJsonAndASelfContainedReport) {
    const Finished f = run_converge({"--size", "40x40", "--spp", "16", "--repeats", "2", "--preset", "strategies"});
    ASSERT_EQ(f.exit_code, 0) << f.err;
    const auto j = json();
    ASSERT_TRUE(j.is_object());
    EXPECT_EQ(j["partial"], false);
    ASSERT_EQ(j["variants"].size(), 3u);
    for (const auto& v : j["variants"]) {
        for (const char* key : {"name", "settings", "points", "slope", "efficiency", "bias"}) EXPECT_TRUE(v.contains(key)) << key;
        EXPECT_EQ(v["bias"]["verdict"], "unbiased-within-noise") << v["name"];
        EXPECT_EQ(v["points"].back()["spp"], 16);
        for (const char* key : {"seconds", "spp", "mse", "relmse", "flip", "mean"}) EXPECT_TRUE(v["points"][0].contains(key)) << key;
    }
    EXPECT_GE(j["reference"]["spp"], 256);
    const std::string csv = text("convergence.csv"), html = text("report.html");
    EXPECT_TRUE(csv.starts_with("variant,seconds,spp,mse,relmse,flip,mean_r,mean_g,mean_b"));
    EXPECT_NE(html.find("<svg"), html.npos);
    EXPECT_NE(html.find("data:image/png;base64,"), html.npos);
    for (const char* outside : {"src='http", "href=", "<script", "url("}) EXPECT_EQ(html.find(outside), html.npos) << outside;
}

TEST_F(Converge, DetectsBiasAndItsSize) {
    const Finished f = run_converge({"--size", "40x40", "--spp", "64", "--repeats", "2", "--variant", "cut: --roulette biased-cut=0.3",
                                     "--variant", "two: --max-bounces 2", "--variant", "right: --roulette luminance"});
    ASSERT_EQ(f.exit_code, 0) << f.err;
    const auto j = json();
    EXPECT_EQ(j["variants"][0]["bias"]["verdict"], "biased");
    EXPECT_LT(j["variants"][0]["bias"]["percent"], -0.5);
    EXPECT_EQ(j["variants"][1]["bias"]["verdict"], "biased");
    EXPECT_LT(j["variants"][1]["bias"]["percent"], -2);
    EXPECT_EQ(j["variants"][2]["bias"]["verdict"], "unbiased-within-noise");
    EXPECT_TRUE(j["variants"][2]["bias"]["bounces"].empty());
    // Bias by bounce: the limit removes all light after two bounces and none before; the biased cut affects several bounces.
    int cut_from = 0;
    for (const auto& b : j["variants"][0]["bias"]["bounces"]) {
        cut_from += b["significant"].get<bool>();
        EXPECT_TRUE(!b["significant"] || b["percent"] < 0) << b.dump();
    }
    EXPECT_GT(cut_from, 1);
    for (const auto& b : j["variants"][1]["bias"]["bounces"]) {
        const bool beyond = std::stoi(b["bounce"].get<std::string>()) > 2;
        EXPECT_EQ(b["significant"], beyond) << b.dump();
        EXPECT_NEAR(b["percent"].get<double>(), beyond ? -b["share_percent"].get<double>() : 0, 1e-9) << b.dump();
    }
}

TEST_F(Converge, CachesAndExtendsItsReference) {
    const std::vector<std::string> few{"--size", "24x24", "--spp", "4", "--repeats", "1"},
        more{"--size", "24x24", "--spp", "8", "--repeats", "1"};
    ASSERT_EQ(run_converge(few).exit_code, 0);
    EXPECT_EQ(json()["reference"]["spp"], 64);
    EXPECT_EQ(json()["reference"]["source"], "rendered");
    ASSERT_EQ(run_converge(more).exit_code, 0);
    EXPECT_EQ(json()["reference"]["spp"], 128);
    EXPECT_EQ(json()["reference"]["source"], "from the cache, extended");
    ASSERT_EQ(run_converge(few).exit_code, 0);
    EXPECT_EQ(json()["reference"]["spp"], 128);
    EXPECT_EQ(json()["reference"]["source"], "from the cache");
    // Another bounce limit converges to another image.
    ASSERT_EQ(run_converge({"--size", "24x24", "--spp", "4", "--repeats", "1", "--max-bounces", "2"}).exit_code, 0);
    EXPECT_EQ(json()["reference"]["source"], "rendered");
}

TEST_F(Converge, RebuildsABrokenCache) {
    const std::vector<std::string> options{"--size", "24x24", "--spp", "4", "--repeats", "1"};
    ASSERT_EQ(run_converge(options).exit_code, 0);
    for (const auto& file : std::filesystem::directory_iterator(folder / "cache/blush/references"))
        ASSERT_TRUE(write_file(file.path(), std::string_view("not an image")));
    ASSERT_EQ(run_converge(options).exit_code, 0);
    EXPECT_EQ(json()["reference"]["source"], "rendered");
}

TEST_F(Converge, ReferencesShareNoSamplesWithVariants) {
    Reference r;
    r.measured.image = {1, 1, {{1, 1, 1}}};
    r.measured.error = {{0.1f, 0.1f, 0.1f}};
    r.measured.samples = 8;
    r.seed = 5;
    const std::filesystem::path cache = folder / "references";
    ASSERT_TRUE(cache_reference(cache, "key", r));
    const uint32_t other[]{4}, same[]{5};
    ASSERT_TRUE(cached_reference(cache, "key", other));
    EXPECT_EQ(cached_reference(cache, "key", other)->measured.samples, 8);
    EXPECT_FALSE(cached_reference(cache, "key", same));
    EXPECT_FALSE(cached_reference(cache, "another key", other));
    // A size limit removes the least recently used entries.
    ASSERT_TRUE(cache_reference(cache, "newer", r, 1));
    EXPECT_FALSE(cached_reference(cache, "key", other));
}

TEST_F(Converge, TakesAReferenceFromAFile) {
    const std::string file = (folder / "ref.exr").string();
    ASSERT_EQ(blush({"render", scene_file("cornell"), "-o", file, "--size", "24x24", "--spp", "256", "--seed", "9", "--layers", "error",
                     "--quiet"})
                  .exit_code,
              0);
    ASSERT_EQ(run_converge({"--size", "24x24", "--spp", "4", "--repeats", "1", "--reference", file}).exit_code, 0);
    EXPECT_EQ(json()["reference"]["source"], "ref.exr");
    EXPECT_EQ(json()["reference"]["spp"], 256);
    const Finished wrong = run_converge({"--size", "32x24", "--spp", "4", "--reference", file});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_TRUE(is_one_line(wrong.err)) << wrong.err;
}

TEST_F(Converge, RefusesInvalidOptions) {
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{"--variant", "nameless"},
                                               {"--preset", "all"},
                                               {"--samples", "0:4"},
                                               {"--error", "0.1"},
                                               {"--repeats", "0"},
                                               {"--variant", "a: ", "--variant", "a: --strategy light"}}) {
        const Finished f = run_converge(options);
        EXPECT_EQ(f.exit_code, 2) << options.front();
        EXPECT_TRUE(is_one_line(f.err)) << f.err;
    }
}

} // namespace
} // namespace blush::test::TEST_FILE
