// Locale-independent parsing of user input, and formatting of numbers.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// True if the whole text is a number that T can represent; sets `number`.
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

// Removes the minus sign of a number that is shown as zero: "-0.00 %" becomes "0.00 %".
inline std::string without_sign_of_zero(std::string text) {
    const size_t sign = text.find_first_not_of(' ');
    if (sign == text.npos || (text[sign] != '-' && text[sign] != '+')) return text;
    const size_t end = std::min(text.find_first_not_of("0123456789.", sign + 1), text.size());
    if (text.find_first_of("123456789", sign) < end || end == sign + 1 || (end < text.size() && (text[end] == 'e' || text[end] == 'n')))
        return text;
    return text.erase(sign, 1);
}

// Number with a sign and this many decimals: "+0.25", "-1.00", "0.00".
inline std::string signed_number(double value, int decimals) {
    char text[400]; // the largest double has 309 digits before its point
    std::snprintf(text, sizeof text, "%+.*f", decimals, value);
    return without_sign_of_zero(text);
}

} // namespace blush
