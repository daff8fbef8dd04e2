// OCIO configs: selection, contents, and handling of broken files.
#include "tests/color/shipped_config.h"
#include "tests/support/process.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace blush::TEST_FILE {
namespace {

// A folder for one test's configs, removed with it.
class ConfigFiles : public testing::Test {
protected:
    ConfigFiles() { unsetenv("OCIO"); }
    ~ConfigFiles() override { unsetenv("OCIO"); }

    std::filesystem::path write(const std::string& text) const {
        const auto file = folder_ / "config.ocio";
        std::ofstream(file) << text;
        return file;
    }

    test::TemporaryFolder temporary_;
    std::filesystem::path folder_ = temporary_.path();
};

// A third-party config with `extra_role` and `spaces` inserted. Its only view is linear.
std::string foreign_config(const std::string& extra_role, const std::string& spaces) {
    return "ocio_profile_version: 2\nname: foreign\nsearch_path: .\nroles:\n  default: working\n  scene_linear: working\n" + extra_role +
           "file_rules:\n  - !<Rule> {name: Default, colorspace: default}\n"
           "displays:\n  Monitor:\n    - !<View> {name: Plain, colorspace: shown}\n"
           "colorspaces:\n" +
           spaces;
}

TEST(Config, ListsDisplaysAndViews) {
    const auto color = shipped_config();
    EXPECT_EQ(color.warning(), "");
    EXPECT_EQ(color.config_name(), "Blush");
    EXPECT_EQ(color.displays(), (std::vector<std::string>{"sRGB", "Rec.1886", "Display P3"}));
    for (const auto& display : color.displays()) {
        EXPECT_EQ(color.views(display), (std::vector<std::string>{"ACES SDR", "Standard", "Raw"}));
        EXPECT_EQ(color.default_view(display), "ACES SDR");
    }
    EXPECT_EQ(color.default_display(), "sRGB");
}

TEST(Config, EmptyNamesMeanTheDefaults) {
    const auto color = shipped_config();
    EXPECT_EQ(show(color, "", "", {0.4f, 0.3f, 0.2f}), show(color, "sRGB", "ACES SDR", {0.4f, 0.3f, 0.2f}));
    EXPECT_EQ(show(color, "Rec.1886", "", {0.4f, 0.3f, 0.2f}), show(color, "Rec.1886", "ACES SDR", {0.4f, 0.3f, 0.2f}));
    EXPECT_EQ(color.display_shader({})->text, color.display_shader({"sRGB", "ACES SDR"})->text);
}

TEST(Config, ErrorsOfUnknownNamesListTheKnownOnes) {
    const auto color = shipped_config();
    Pixel p = grey(0.5f);
    const auto view = color.apply_display({"sRGB", "Sepia"}, {}, p.data(), 1);
    ASSERT_FALSE(view);
    EXPECT_EQ(view.error().text(), "no view \"Sepia\" for display \"sRGB\"; there are: ACES SDR, Standard, Raw");
    const auto display = color.display_shader({"CRT"});
    ASSERT_FALSE(display);
    EXPECT_EQ(display.error().text(), "no display \"CRT\"; there are: sRGB, Rec.1886, Display P3");
    const auto look = color.display_shader({"", "", "Sepia"});
    ASSERT_FALSE(look);
    EXPECT_EQ(look.error().text(), "no look \"Sepia\"; there are: Low contrast, High contrast, Black and white");
    EXPECT_EQ(p, grey(0.5f));
}

TEST_F(ConfigFiles, BrokenConfigsFallBackToTheShippedOne) {
    const std::string working = "  - !<ColorSpace> {name: working}\n";
    const std::string missing_table = "  - !<ColorSpace> {name: shown, from_scene_reference: !<FileTransform> {src: absent.spi1d}}\n";
    const std::string broken[] = {
        "",
        "ocio_profile_version: [",
        std::string("\0\xff binary", 9),
        "ocio_profile_version: 99\n",
        foreign_config("", working),                 // its view names a missing color space
        foreign_config("", working + missing_table), // its view needs a missing file
    };
    for (const auto& text : broken) {
        const auto file = write(text);
        const auto color = ColorManagement::load(BLUSH_ASSETS, file);
        ASSERT_TRUE(color) << color.error().text();
        EXPECT_EQ(color->config_name(), "Blush");
        EXPECT_NE(color->warning().find(file.string()), std::string::npos) << text;
        EXPECT_EQ(color->warning().find('\n'), std::string::npos) << color->warning();
        EXPECT_EQ(show(*color, "sRGB", "Raw", grey(0.5f)), grey(0.5f));
    }
    const auto absent = ColorManagement::load(BLUSH_ASSETS, folder_ / "absent.ocio");
    ASSERT_TRUE(absent);
    EXPECT_NE(absent->warning().find("absent.ocio"), std::string::npos);
}

// With any invalid config there is a fallback config.
TEST_F(ConfigFiles, AnyBytesGiveAConfig) {
    std::ifstream shipped(std::filesystem::path(BLUSH_ASSETS) / "ocio" / "config.ocio");
    const std::string whole(std::istreambuf_iterator<char>(shipped), {});
    std::mt19937 random(4);
    int as_they_are = 0;
    constexpr int tries = 60;
    for (int i = 0; i < tries; ++i) {
        std::string broken = i % 2 ? whole.substr(0, random() % whole.size()) : whole;
        for (int flips = i % 3; flips > 0 && !broken.empty(); --flips) broken[random() % broken.size()] = char(random());
        const auto color = ColorManagement::load(BLUSH_ASSETS, write(broken));
        ASSERT_TRUE(color) << color.error().text();
        as_they_are += color->warning().empty();
    }
    EXPECT_GT(as_they_are, 0);
    EXPECT_LT(as_they_are, tries);
    // Infinite nesting, aliases of aliases, too large, missing file.
    std::string laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 12; ++i) {
        laughs += fmt::format("a{}: &a{} [", i, i);
        for (int k = 0; k < 10; ++k) laughs += fmt::format("{}*a{}", k ? ", " : "", i - 1);
        laughs += "]\n";
    }
    for (const std::string& text : {std::string(200000, '['), laughs, whole + std::string(9 << 20, ' ')})
        EXPECT_NE(ColorManagement::load(BLUSH_ASSETS, write(text))->warning(), "");
    EXPECT_NE(ColorManagement::load(BLUSH_ASSETS, "/dev/zero")->warning(), "");
}

TEST_F(ConfigFiles, ABrokenShippedConfigIsAnError) {
    const auto color = ColorManagement::load(folder_);
    ASSERT_FALSE(color);
    EXPECT_NE(color.error().text().find("config.ocio"), std::string::npos);
}

TEST_F(ConfigFiles, EnvironmentIsRespectedAndAnArgumentWins) {
    const auto file = write(foreign_config("", "  - !<ColorSpace> {name: working}\n  - !<ColorSpace> {name: shown}\n"));
    setenv("OCIO", file.c_str(), 1);
    const auto by_environment = ColorManagement::load(BLUSH_ASSETS);
    ASSERT_TRUE(by_environment);
    EXPECT_EQ(by_environment->warning(), "");
    EXPECT_EQ(by_environment->config_name(), "foreign");
    EXPECT_EQ(by_environment->displays(), std::vector<std::string>{"Monitor"});

    const auto by_argument = ColorManagement::load(BLUSH_ASSETS, std::filesystem::path(BLUSH_ASSETS) / "ocio" / "config.ocio");
    ASSERT_TRUE(by_argument);
    EXPECT_EQ(by_argument->config_name(), "Blush");

    setenv("OCIO", "", 1);
    EXPECT_EQ(ColorManagement::load(BLUSH_ASSETS)->config_name(), "Blush");
}

// The working space is Rec.709 whatever the config works in: where the config says how to reach ACES2065-1, white
// stays white and red becomes that red; otherwise values pass unchanged.
TEST_F(ConfigFiles, WorkingSpaceIsFoundInOtherConfigs) {
    const std::string acescg = "  - !<ColorSpace> {name: working, to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}}\n"
                               "  - !<ColorSpace> {name: ap0}\n";
    const std::string shows_acescg =
        "  - !<ColorSpace> {name: shown, to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}}\n";
    const auto exchange = ColorManagement::load(BLUSH_ASSETS, write(foreign_config("  aces_interchange: ap0\n", acescg + shows_acescg)));
    ASSERT_TRUE(exchange);
    ASSERT_EQ(exchange->warning(), "");
    const Pixel white = show(*exchange, "", "", grey(0.5f)), red = show(*exchange, "", "", {1, 0, 0});
    for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 0.5f, 1e-4); // the published matrices are rounded to some six digits
    // The first column of the matrix from Rec.709 to ACEScg (AP1, D60 by Bradford).
    EXPECT_NEAR(red[0], 0.6131, 1e-4);
    EXPECT_NEAR(red[1], 0.0702, 1e-4);
    EXPECT_NEAR(red[2], 0.0206, 1e-4);

    const std::string named = "  - !<ColorSpace> {name: lin_rec709, from_scene_reference: !<MatrixTransform> "
                              "{matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}}\n";
    const std::string plain = "  - !<ColorSpace> {name: working}\n  - !<ColorSpace> {name: shown}\n";
    const auto by_name = ColorManagement::load(BLUSH_ASSETS, write(foreign_config("", plain + named)));
    ASSERT_TRUE(by_name);
    EXPECT_EQ(show(*by_name, "", "", {0.1f, 0.2f, 0.3f}), (Pixel{0.2f, 0.4f, 0.6f}));

    const auto silent = ColorManagement::load(BLUSH_ASSETS, write(foreign_config("", plain)));
    ASSERT_TRUE(silent);
    EXPECT_EQ(show(*silent, "", "", {0.1f, 0.2f, 0.3f}), (Pixel{0.1f, 0.2f, 0.3f}));
}

} // namespace
} // namespace blush::TEST_FILE
