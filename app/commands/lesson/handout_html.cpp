// The page of a handout.
#include "app/commands/base64.h"
#include "app/commands/converge/report.h"
#include "app/commands/error_text.h"
#include "app/commands/lesson/handout.h"
#include "measure/plot/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace blush {
namespace {

constexpr const char* style = R"(
body{font:17px/1.55 system-ui,sans-serif;color:#222;background:#fff;max-width:46rem;margin:2rem auto;padding:0 1.5rem}
h1{font-size:1.8rem;margin:0 0 .4rem} h2{font-size:1.3rem;margin:2.6rem 0 .6rem;border-top:1px solid #ddd;padding-top:1.2rem}
.quiet,figcaption,table{font-size:.88rem} .quiet,figcaption{color:#555} figure{margin:1rem 0} img{display:block;max-width:100%;height:auto}
svg{max-width:100%;height:auto} .biased{color:#a33000;font-weight:600} .question{font-weight:600} details{margin:.5rem 0} summary{cursor:pointer}
table{border-collapse:collapse;font-variant-numeric:tabular-nums} th,td{padding:.25rem .9rem .25rem 0;border-bottom:1px solid #ddd;text-align:left;vertical-align:top}
code{font-size:.92em;overflow-wrap:anywhere}
@media print{body{margin:0;max-width:none;font-size:11pt} h2{break-after:avoid} figure,tr{break-inside:avoid}}
)";

// The page itself needs nothing: this also keeps a reader's browser from loading what an edit of the file might add.
constexpr const char* policy = "default-src 'none'; img-src data:; style-src 'unsafe-inline'";

// Where a mark of emphasis that opens at `at` closes: neither has a space on its inner side. npos: nowhere.
size_t find_close(const std::string& text, size_t at, const std::string& mark) {
    const size_t inner = at + mark.size();
    if (inner >= text.size() || text[inner] == ' ') return text.npos;
    size_t close = text.find(mark, inner + 1);
    while (close != text.npos && text[close - 1] == ' ') close = text.find(mark, close + 1);
    return close;
}

// One paragraph with its emphasis and code. A mark without a partner, and marks within others, are text.
std::string inline_html(const std::string& text) {
    const std::pair<std::string, const char*> marks[] = {{"`", "code"}, {"**", "strong"}, {"*", "em"}};
    std::string html, plain;
    for (size_t at = 0; at < text.size();) {
        const auto kind = std::ranges::find_if(marks, [&](const auto& m) { return text.compare(at, m.first.size(), m.first) == 0; });
        const size_t length = kind == std::end(marks) ? 1 : kind->first.size();
        const size_t close = kind == std::end(marks) ? text.npos : find_close(text, at, kind->first);
        if (close == text.npos) {
            plain.append(text, at, length);
            at += length;
            continue;
        }
        const std::string inside = text.substr(at + length, close - at - length);
        html += escaped_markup(plain) + fmt::format("<{0}>{1}</{0}>", kind->second, escaped_markup(inside));
        plain.clear();
        at = close + length;
    }
    return html + escaped_markup(plain);
}

// What each picture is worth: its samples and its error.
std::string worth(const HandoutStep& s) {
    std::string text = fmt::format("{} × {} pixels, {} samples per pixel in {:.2g} s", s.width, s.height, s.samples, s.seconds);
    text += ", " + error_text(s.error, 3) + ".";
    if (!s.missing_light.empty()) text += fmt::format(" Some light cannot be found: {}.", s.missing_light);
    return escaped_markup(text);
}

std::string figure(const LessonStep& step, const HandoutStep& s) {
    std::string html = fmt::format("<figure><img width='{}' height='{}' alt='{}' src='data:image/png;base64,{}'><figcaption>{}", s.width,
                                   s.height, escaped_markup("Picture of the step: " + step.title), base64(s.png), worth(s));
    if (!s.bias.empty())
        html += fmt::format(" <span class='biased'>Biased: {}; the error is that of noise alone.</span>", escaped_markup(s.bias));
    return html + "</figcaption></figure>\n";
}

// Error against time, if the step talks about it.
std::string curve(const LessonStep& step, const HandoutStep& s) {
    if (std::ranges::find(step.panels, "convergence") == step.panels.end()) return {};
    if (s.rms.size() < 2) return "<p class='quiet'>No error curve: the error is not known at two or more numbers of samples.</p>\n";
    Plot plot{"Error against time", "seconds of rendering", "estimated RMSE", {}, {}, {}};
    plot.curves.push_back({s.bias.empty() ? "this picture" : "this picture, noise alone", plot_color(0), s.rms});
    plot.curves.push_back(plot_guide(plot, -0.5, "1/√N (reference slope)"));
    return "<figure>" + to_svg(plot) + "<figcaption>At growing numbers of samples, with 95 % intervals.</figcaption></figure>\n";
}

std::string claims(const LessonStep& step, const HandoutStep& s) {
    if (s.claims.empty()) return {};
    constexpr const char* verdicts[] = {"holds", "is wrong", "is not decided"};
    std::string html = "<table><thead><tr><th>Words of the text</th><th>Measured, with 95 % interval</th><th></th></tr></thead><tbody>\n";
    for (size_t i = 0; i < s.claims.size(); ++i)
        html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", escaped_markup(step.claims[i].says),
                            escaped_markup(claim_text(step.claims[i], s.claims[i])), verdicts[int(s.claims[i].verdict)]);
    return html + "</tbody></table>\n";
}

std::string question(const LessonStep& step) {
    if (step.question.empty()) return {};
    std::string html = fmt::format("<p class='question'>{}</p>\n", inline_html(step.question));
    if (!step.expect.empty()) html += fmt::format("<details><summary>Answer</summary><p>{}</p></details>\n", inline_html(step.expect));
    return html;
}

// "scene cornell.gltf, spp 16, reuse off"
std::string state_text(const LessonStep& step) {
    std::string text = "Scene " + step.scene;
    if (!step.camera.empty()) text += ", camera " + step.camera;
    for (const auto& [name, value] : step.settings)
        if (name != "size") text += fmt::format(", {} {}", name, value);
    return fmt::format("<p class='quiet'>{}</p>\n", escaped_markup(text));
}

} // namespace

std::string html_of_markdown(const std::string& markdown) {
    std::string html, open; // the paragraph or entry that is being read
    bool list = false, entry = false;
    const auto close = [&] {
        if (open.empty()) return;
        if (entry != list) html += entry ? "<ul>\n" : "</ul>\n";
        list = entry;
        html += fmt::format("<{0}>{1}</{0}>\n", entry ? "li" : "p", inline_html(open));
        open.clear();
    };
    std::istringstream lines(markdown);
    for (std::string line; std::getline(lines, line);) {
        const size_t first = line.find_first_not_of(" \t\r");
        if (first == line.npos) {
            close();
            continue;
        }
        line = line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
        const bool begins = line.starts_with("- ") || line.starts_with("* ");
        if (begins) {
            close();
            line = line.substr(2);
        }
        if (open.empty()) entry = begins;
        open += (open.empty() ? "" : " ") + line;
    }
    close();
    return html + (list ? "</ul>\n" : "");
}

std::string handout_html(const Lesson& lesson, const std::vector<HandoutStep>& steps) {
    std::string html =
        fmt::format("<!DOCTYPE html>\n<html lang='en'>\n<head><meta charset='utf-8'>"
                    "<meta http-equiv='Content-Security-Policy' content=\"{}\">"
                    "<meta name='viewport' content='width=device-width'>\n<title>{}</title>\n<style>{}</style></head>\n<body>\n",
                    policy, escaped_markup(lesson.title), style);
    html += fmt::format("<h1>{}</h1>\n{}", escaped_markup(lesson.title), html_of_markdown(lesson.about));
    for (size_t i = 0; i < steps.size(); ++i) {
        const LessonStep& step = lesson.steps[i];
        html += fmt::format("<section>\n<h2>{}. {}</h2>\n", i + 1, escaped_markup(step.title));
        html += html_of_markdown(step.text) + figure(step, steps[i]) + curve(step, steps[i]) + claims(step, steps[i]) + question(step) +
                state_text(step) + "</section>\n";
    }
    html += fmt::format("<footer class='quiet'><p>Rendered and measured by Blush {} on {}. Errors are estimated from two halves of the "
                        "samples, with 95 % intervals. RMSE is in scene-linear values; relMSE is relative to the brightness of each pixel. "
                        "Quantities of claims "
                        "are measured at the size of the step, by other samples than those of its picture.</p></footer>\n",
                        BLUSH_VERSION, escaped_markup(machine_text()));
    return html + "</body>\n</html>\n";
}

} // namespace blush
