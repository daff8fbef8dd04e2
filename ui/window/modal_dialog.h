// Content of a modal dialog: a question, and what the user can choose.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blush {

struct ModalDialog {
    std::string text;
    std::string details;              // smaller text below; may be empty
    std::vector<std::string> choices; // Enter chooses the focused one, Esc the last
    size_t focused = 0;               // moved by Tab and arrow keys
    std::optional<size_t> chosen = {};
};

} // namespace blush
