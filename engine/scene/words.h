// Converts between enumerators and their names on the command line.
#pragma once

#include "core/result.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

namespace blush {

template <class E> struct Word {
    E value;
    std::string_view text;
};

// Empty for a value without a name.
template <class E, size_t n> std::string_view word_of(const std::array<Word<E>, n>& words, E value) {
    for (const Word<E>& w : words)
        if (w.value == value) return w.text;
    return {};
}

// Error: unknown name; the message lists the known ones.
template <class E, size_t n> Result<E> value_of(const std::array<Word<E>, n>& words, std::string_view text, std::string_view kind) {
    std::string known;
    for (const Word<E>& w : words) {
        if (w.text == text) return w.value;
        if (!known.empty()) known += ", ";
        known += w.text;
    }
    return Error{.what = fmt::format("unknown {} \"{}\" (known: {})", kind, text, known)};
}

} // namespace blush
