// Something that the user has to decide before the window goes on.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blush {

struct Question {
    std::string text;
    std::string details;              // smaller, below; may be empty
    std::vector<std::string> choices; // the first is what Enter means, the last what Esc means
    std::optional<size_t> chosen = {};
};

} // namespace blush
