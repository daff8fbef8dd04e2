// Handouts: the HTML of hostile text, pictures equal to those of `blush render`, error curves, claims, exit codes.
#include "app/commands/lesson/handout.h"
#include "io/image/image_io.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <optional>
#include <sstream>

namespace blush::TEST_FILE {
namespace {

using test::blush;
using test::Finished;
using test::TemporaryFolder;

const std::string two_steps = "---\nlesson: Light & <b>shade</b>\n---\nAbout <i>this</i>.\n"
                              "---\nstep: \"One\" <script>alert(1)</script>\nscene: cornell.gltf\nset: size=32x16\nset: max-bounces=2\n"
                              "set: spp=16\nopen: convergence\nquestion: Why <u>?\nexpect: So & so.\n"
                              "claim: \"some light\": share of direct at 10,4,8,8 is 0.1 to 0.99\n---\n"
                              "There is *some\nlight*, and <img src=x onerror=alert(1)>.\n\n- first `a<b`\n- second\n"
                              "---\nstep: Two\nreset: settings\nset: size=16x32\n---\nText.\n";

std::string written(const TemporaryFolder& folder, const std::string& text) {
    const std::string file = folder / "lesson.md";
    std::ofstream(file) << text;
    return file;
}

std::string content(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

size_t count(const std::string& text, const std::string& part) {
    size_t n = 0;
    for (size_t at = text.find(part); at != text.npos; at = text.find(part, at + part.size())) ++n;
    return n;
}

std::vector<uint8_t> from_base64(const std::string& text) {
    const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<uint8_t> bytes;
    uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const size_t value = alphabet.find(c);
        if (value == alphabet.npos) break; // padding
        bits = bits << 6 | uint32_t(value);
        if ((held += 6) >= 8) bytes.push_back(uint8_t(bits >> (held -= 8)));
    }
    return bytes;
}

// The pictures of the page, decoded.
std::vector<ImagePtr> pictures(const std::string& html) {
    const std::string begin = "src='data:image/png;base64,";
    std::vector<ImagePtr> found;
    for (size_t at = html.find(begin); at != html.npos; at = html.find(begin, at + 1)) {
        const size_t data = at + begin.size();
        const auto image = read_image(from_base64(html.substr(data, html.find('\'', data) - data)), "picture");
        EXPECT_TRUE(image);
        found.push_back(image ? *image : nullptr);
    }
    return found;
}

// Every tag that opens is closed in order: text of the lesson has not become markup.
std::optional<std::string> imbalance(const std::string& html) {
    std::vector<std::string> open;
    for (size_t at = html.find('<'); at != html.npos; at = html.find('<', at + 1)) {
        const size_t end = html.find('>', at);
        if (end == html.npos) return "a tag does not end";
        const bool closes = html[at + 1] == '/', empty = html[end - 1] == '/';
        const std::string name = html.substr(at + 1 + closes, html.find_first_of(" />", at + 1 + closes) - at - 1 - closes);
        if (name == "!DOCTYPE" || name == "meta" || name == "img" || empty) continue;
        if (!closes)
            open.push_back(name);
        else if (open.empty() || open.back() != name)
            return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
        else
            open.pop_back();
    }
    return open.empty() ? std::nullopt : std::optional(open.back() + " stays open");
}

TEST(HandoutMarkdown, HasParagraphsListsEmphasisAndNothingElse) {
    EXPECT_EQ(html_of_markdown("One\ntwo.\n\nThree."), "<p>One two.</p>\n<p>Three.</p>\n");
    EXPECT_EQ(html_of_markdown("Text\n- a\n- b\n  c\n\nEnd"), "<p>Text</p>\n<ul>\n<li>a</li>\n<li>b c</li>\n</ul>\n<p>End</p>\n");
    EXPECT_EQ(html_of_markdown("*a* **b** `c*`"), "<p><em>a</em> <strong>b</strong> <code>c*</code></p>\n");
    EXPECT_EQ(html_of_markdown("2 * 3, `x, **"), "<p>2 * 3, `x, **</p>\n");
    EXPECT_EQ(html_of_markdown("# <a href='x'>\"&"), "<p># &lt;a href=&#39;x&#39;&gt;&quot;&amp;</p>\n");
    EXPECT_EQ(html_of_markdown("*<b>* `</p>`"), "<p><em>&lt;b&gt;</em> <code>&lt;/p&gt;</code></p>\n");
    EXPECT_EQ(html_of_markdown(""), "");
}

TEST(HandoutBias, IsThatOfTheSettings) {
    RenderSettings settings = recommended_settings();
    EXPECT_EQ(bias_of_settings(settings), "");
    settings.roulette = {.rule = Roulette::Rule::constant, .probability = 0.5f};
    settings.strategy = Strategy::bsdf;
    EXPECT_EQ(bias_of_settings(settings), "");
    settings.max_bounces = 1;
    EXPECT_EQ(bias_of_settings(settings), "light of more than 1 bounce is missing");
    settings.roulette.rule = Roulette::Rule::biased_cut;
    settings.clamp.limit = 10;
    EXPECT_EQ(count(bias_of_settings(settings), ";"), 2u);
}

TEST(Handout, IsOneSafeFile) {
    const TemporaryFolder folder;
    const std::string out = folder / "page.html";
    std::ofstream(out) << "older";
    const Finished done = blush({"lesson", "export", written(folder, two_steps), "-o", out, "--size", "128", "--spp", "256"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_NE(done.out.find("2 steps, 1 of 1 claims hold"), std::string::npos) << done.out;
    size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(out).parent_path())) files += entry.exists();
    EXPECT_EQ(files, 2u) << "a temporary file is left";
    const std::string html = content(out);
    EXPECT_EQ(imbalance(html), std::nullopt);
    EXPECT_EQ(count(html, "<section>"), 2u);
    EXPECT_EQ(count(html, "<details>"), 1u);
    EXPECT_NE(html.find("<summary>Answer</summary><p>So &amp; so.</p>"), html.npos);
    EXPECT_NE(html.find("<h1>Light &amp; &lt;b&gt;shade&lt;/b&gt;</h1>"), html.npos);
    EXPECT_NE(html.find("&quot;One&quot; &lt;script&gt;alert(1)&lt;/script&gt;"), html.npos);
    EXPECT_NE(html.find("<em>some light</em>, and &lt;img src=x onerror=alert(1)&gt;."), html.npos);
    EXPECT_NE(html.find("<li>first <code>a&lt;b</code></li>"), html.npos);
    for (const char* outside : {"<script", "<link", "<iframe", "<object", "<a ", "href=", "url(", "@import", "https:", "<img src=x"})
        EXPECT_EQ(html.find(outside), html.npos) << outside;
    EXPECT_EQ(count(html, "src="), count(html, "src='data:") + count(html, "&lt;img src=x"));
    EXPECT_EQ(count(html, "http:"), count(html, "xmlns='http://www.w3.org/2000/svg'")); // a name, which nothing loads
    // Both sizes are those of the steps, with a longer side of 128 pixels.
    const std::vector<ImagePtr> images = pictures(html);
    ASSERT_EQ(images.size(), 2u);
    EXPECT_EQ(std::pair(images[0]->width, images[0]->height), std::pair(128, 64));
    EXPECT_EQ(std::pair(images[1]->width, images[1]->height), std::pair(64, 128));
    // The first step opens the convergence chart and limits bounces.
    EXPECT_EQ(count(html, "<svg"), 1u);
    EXPECT_GE(count(html, "<circle"), 3u) << "points of the error curve";
    EXPECT_EQ(count(html, "<span class='biased'>Biased: light of more than 2 bounces is missing"), 1u);
    EXPECT_EQ(count(html, "256 samples per pixel in "), 2u);
    EXPECT_EQ(count(html, "RMSE 0."), 2u);
    EXPECT_EQ(count(html, "<td>holds</td>"), 1u);
}

TEST(Handout, ShowsTheImageOfTheStep) {
    const TemporaryFolder folder;
    const std::string out = folder / "page.html", png = folder / "image.png";
    // Samples are those of the step unless --spp is given; exposure is metered, as in the window.
    ASSERT_EQ(blush({"lesson", "export", written(folder, two_steps), "-o", out, "--size", "32", "--no-claims"}).exit_code, 0);
    ASSERT_EQ(blush({"render", test::scene_file("cornell"), "-o", png, "--size", "32x16", "--spp", "16", "--max-bounces", "2",
                     "--auto-exposure", "average"})
                  .exit_code,
              0);
    const std::string html = content(out);
    EXPECT_EQ(count(html, "<table>"), 0u) << "claims that were not measured";
    EXPECT_EQ(count(html, ", 16 samples per pixel"), 1u);
    EXPECT_EQ(count(html, ", 64 samples per pixel"), 1u);
    const std::vector<ImagePtr> images = pictures(html);
    const auto rendered = read_image(png);
    ASSERT_TRUE(rendered);
    ASSERT_EQ(images.size(), 2u);
    ASSERT_EQ(images[0]->channels, (*rendered)->channels);
    EXPECT_EQ(images[0]->bytes, (*rendered)->bytes);
}

TEST(Handout, FailsWithItsExitCode) {
    const TemporaryFolder folder;
    const std::string lesson = written(folder, two_steps), out = folder / "page.html";
    const auto code = [](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"lesson", "export"});
        return blush(std::move(arguments)).exit_code;
    };
    EXPECT_EQ(code({lesson}), 2);                                  // no -o
    EXPECT_EQ(code({lesson, "-o", folder / "page.png"}), 2);       // not HTML
    EXPECT_EQ(code({lesson, "-o", out, "--size", "8"}), 2);        // too small
    EXPECT_EQ(code({lesson, "-o", out, "--spp", "0"}), 2);         // no samples
    EXPECT_EQ(code({folder / "none.md", "-o", out}), 1);           // no lesson
    EXPECT_EQ(code({lesson, "-o", folder / "none/page.html"}), 1); // no folder
    EXPECT_EQ(code({written(folder, "no lesson"), "-o", out}), 1); // invalid
    EXPECT_FALSE(std::filesystem::exists(out)) << "a page after an error";
}

} // namespace
} // namespace blush::TEST_FILE
