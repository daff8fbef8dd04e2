#pragma once

#include "core/result.h"

#include <cstdio>
#include <cstdlib>

namespace blush::fuzz {

// Ends the process, as fuzzers want it, with the words of what went wrong.
template <class T> void promise(const Result<T>& holds) {
    if (holds) return;
    std::fprintf(stderr, "a promise is broken: %s\n", holds.error().text().c_str());
    std::abort();
}

} // namespace blush::fuzz
