// Small readers for text that people type: the same whatever the locale, and never half of a word.
#pragma once

#include <charconv>
#include <string_view>
#include <vector>

namespace blush {

// True if all of `text` is one number that T holds; `number` is then set.
template <class T> bool parse_number(std::string_view text, T& number) {
    T parsed{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), parsed);
    if (code != std::errc() || end != text.data() + text.size()) return false;
    number = parsed;
    return true;
}

// The parts between separators; n separators give n + 1 parts, some perhaps empty.
inline std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const size_t end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == text.npos) return parts;
        text.remove_prefix(end + 1);
    }
}

} // namespace blush
