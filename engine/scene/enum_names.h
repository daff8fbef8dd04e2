// Converts between enumerators and their names on the command line.
#pragma once

#include "core/result.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

namespace blush {

template <class E> struct EnumName {
    E value;
    std::string_view text;
};

// Empty for a value without a name.
template <class E, size_t n> std::string_view enum_to_string(const std::array<EnumName<E>, n>& words, E value) {
    for (const EnumName<E>& w : words)
        if (w.value == value) return w.text;
    return {};
}

// Error: unknown name; the message lists the known ones.
template <class E, size_t n>
Result<E> enum_from_string(const std::array<EnumName<E>, n>& words, std::string_view text, std::string_view kind) {
    std::string known;
    for (const EnumName<E>& w : words) {
        if (w.text == text) return w.value;
        if (!known.empty()) known += ", ";
        known += w.text;
    }
    return Error{.what = fmt::format("unknown {} \"{}\" (known: {})", kind, text, known)};
}

} // namespace blush
