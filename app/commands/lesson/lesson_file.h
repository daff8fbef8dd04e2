// Lessons: steps in Markdown, each with the state of the window that it talks about and the claims that its text makes.
// The format is described in docs/guide/lessons.md.
#pragma once

#include "app/commands/plan/look_words.h"
#include "core/result.h"
#include "scene/image_region.h"

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// A number in the text of a step, and how it is measured (claims.h).
struct LessonClaim {
    enum class Quantity {
        share,     // of a sender, of direct or of indirect light in the light of a rectangle of pixels, 0 .. 1
        luminance, // mean of a rectangle of pixels, nits
        noise,     // root of the mean squared error of the image with another setting, relative to that of the step
        mean,      // mean luminance of the image with another setting, relative to that of the step
    };
    size_t line = 0;
    std::string says; // the words of the text
    Quantity quantity = Quantity::share;
    std::string name;           // share: "direct", "indirect", or name of the sender
    std::array<int, 4> rect{};  // share, luminance: x, y, width, height in pixels of an image of the step's size
    std::string setting, value; // noise, mean: what changes
    double low = 0, high = 0;   // both included
};

struct LessonStep {
    size_t line = 0;                             // of its title
    std::string title, text;                     // the text is Markdown, of which the window shows paragraphs, lists and emphasis
    std::string question, expect;                // empty: none
    std::string scene, camera;                   // as written; camera: empty: the scene's first
    std::filesystem::path file = {};             // of the scene: see read_lesson()
    std::map<std::string, std::string> settings; // of `blush render`, "max-bounces": "2"
    std::vector<std::string> panels;             // instruments to open, others close
    std::string tool;                            // empty: none
    std::string highlight;                       // name of a widget, as UI tests know it: "Lesson/Next"; empty: none
    std::vector<LessonClaim> claims;
    std::map<std::string, size_t> lines; // of the keys "scene", "camera", and of settings
};

struct Lesson {
    std::filesystem::path file;
    std::string title, about;
    std::vector<LessonStep> steps; // at least one
};

constexpr uint64_t max_lesson_bytes = uint64_t(1) << 20;
constexpr size_t max_lesson_steps = 200, max_step_claims = 20, max_highlight = 100;
// The panels and tools that a step may open, by their names in window.json.
constexpr std::array<const char*, 13> lesson_panels{"bleed",     "bounces",     "convergence", "health", "integrators",
                                                    "light_mix", "light_table", "meters",      "paths",  "roulette",
                                                    "samplers",  "scopes",      "strategies"};
constexpr std::array<const char*, 3> lesson_tools{"bleed", "measure", "paths"};

// The steps of a text. `name`: of the file, for messages. Scene, camera and settings carry over from step to step. Errors, with
// FILE:LINE: unknown keys, panels, tools, settings and their invalid values; missing titles; claims whose words the text does not have.
Result<Lesson> parse_lesson(std::string_view text, const std::string& name);

// Reads a lesson and finds the scenes of its steps: files in the folder of the lesson, or in `scenes`, the folder of shipped ones.
// Errors: as of parse_lesson(); unreadable or larger than max_lesson_bytes; a scene that is missing or outside of both folders.
Result<Lesson> read_lesson(const std::filesystem::path& file, const std::filesystem::path& scenes);

// The options of `blush render` for a step, or with one setting changed, which may be the integrator. Errors: as of options_of() and
// parse_integrator().
Result<RenderOptions> options_of_step(const LessonStep& step);
Result<RenderOptions> options_with(const LessonStep& step, const std::string& setting, const std::string& value);

} // namespace blush
