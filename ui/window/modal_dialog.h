// Content of a modal dialog.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blush {

struct Question {
    std::string text;
    std::string details;              // smaller text below; may be empty
    std::vector<std::string> choices; // Enter chooses the first, Esc the last
    std::optional<size_t> chosen = {};
};

} // namespace blush
