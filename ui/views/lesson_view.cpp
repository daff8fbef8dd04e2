#include "ui/views/lesson_view.h"

#include <sstream>

namespace blush {

std::vector<std::string> paragraphs_of(const std::string& markdown) {
    std::vector<std::string> paragraphs;
    std::istringstream lines(markdown);
    bool begins = true;
    for (std::string line; std::getline(lines, line);) {
        const size_t first = line.find_first_not_of(" \t\r");
        if (first == std::string::npos) {
            begins = true;
            continue;
        }
        line = line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
        std::string plain;
        const bool entry = line.starts_with("- ") || line.starts_with("* ");
        for (const char c : entry ? line.substr(2) : line)
            if (c != '*' && c != '`') plain += c;
        if (begins || entry)
            paragraphs.push_back(entry ? "- " + plain : plain);
        else
            paragraphs.back() += " " + plain;
        begins = false;
    }
    return paragraphs;
}

} // namespace blush
