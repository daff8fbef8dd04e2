// The lesson that the window shows (ui/panels/lesson.cpp), and what its panel asks the editor for.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace blush {

struct LessonView {
    // The toast for what would read or write files of the user's scene.
    static constexpr const char* refusal = "Not available during a lesson";
    static constexpr const char* refusal_details = "End the lesson first: it shows a scene of its own, and yours waits unchanged.";

    struct Step {
        std::string title, text;      // the text is Markdown
        std::string question, expect; // empty: none
        std::string highlight;        // widget with a frame around it, by its name in the probe; empty: none
    };
    struct File {
        std::string title;
        std::filesystem::path file;
    };

    std::string title;
    std::vector<Step> steps; // empty: no lesson
    size_t step = 0;
    bool answer = false;       // what the step expects is shown
    std::vector<File> shipped; // of the menu

    // Requests to the editor.
    std::optional<std::filesystem::path> to_open = {};
    std::optional<size_t> to_step = {};
    bool to_end = false;

    bool is_on() const { return !steps.empty(); }
};

// The paragraphs of a text in Markdown: lines that belong together are joined, marks of emphasis and code are removed. An entry of a list
// is a paragraph of its own.
std::vector<std::string> paragraphs_of(const std::string& markdown);

} // namespace blush
